#include "sensors/sensor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/units.h"

namespace tera {
namespace {

using ::testing::HasSubstr;

SensorDescription SensorRead(const std::string& keys) {
  const Config config = Config::FromText("sensor: {" + keys + "}", "rig.yaml");
  const SensorDescription sensor = ReadSensor(config.root().Map("sensor"));
  config.Finish();
  return sensor;
}

std::string SensorFaultOf(const std::string& keys) {
  try {
    SensorRead(keys);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no fault";
}

template <typename Model>
Model ModelOf(const std::string& keys) {
  return std::get<Model>(SensorRead("name: s, link: upper, rate_hz: 10, " + keys).model);
}

TEST(ReadSensor, PlaceRateAndLatencyAreRead) {
  const SensorDescription s = SensorRead(
      "name: imu_boom, type: imu, link: boom, xyz_m: [1, 2, 3], rpy_deg: [0, 0, 90], "
      "rate_hz: 200, latency_s: 0.025");
  EXPECT_EQ(s.name, "imu_boom");
  EXPECT_EQ(s.link, "boom");
  EXPECT_EQ(TypeOf(s), "imu");
  EXPECT_EQ(s.clock.rate_hz, 200);
  EXPECT_EQ(s.latency_ns, 25'000'000);
  EXPECT_NEAR((s.X_BS * Vec3(1, 0, 0) - Vec3(1, 3, 3)).norm(), 0, 1e-12);
}

TEST(ReadSensor, EveryPresetIsWhole) {
  for (const auto& [preset, type] : {std::pair{"xsens_mti_670", "imu"},
                                     {"icm_20948", "imu"},
                                     {"rtk_f9p", "gnss"},
                                     {"paper_gps", "gnss"},
                                     {"rgb_640", "camera"},
                                     {"realsense_d435i", "camera"},
                                     {"vlp16", "lidar"},
                                     {"os1_64", "lidar"},
                                     {"os1_128", "lidar"},
                                     {"encoder", "encoder"}}) {
    const std::string place = std::string(type) == "encoder" ? "" : "link: upper, ";
    const SensorDescription s =
        SensorRead("name: s, " + place + "preset: 'tera:config/sensors/" + preset + ".yaml'");
    EXPECT_EQ(TypeOf(s), type) << preset;
  }
}

TEST(ReadSensor, KeysBesideThePresetPrevail) {
  const SensorDescription s = SensorRead(
      "name: s, link: upper, preset: 'tera:config/sensors/os1_64.yaml', rate_hz: 20, "
      "max_range_m: 30");
  EXPECT_EQ(s.clock.rate_hz, 20);
  EXPECT_EQ(std::get<LidarModel>(s.model).max_range_m, 30);
  EXPECT_EQ(std::get<LidarModel>(s.model).columns, 1024);
}

TEST(ReadSensor, ImuKeysReachTheModelInSiUnits) {
  const auto m = ModelOf<ImuModel>(
      "type: imu, gyro_noise_density_degpsrthz: 2, gyro_bias_random_walk_degps2rthz: 3, "
      "gyro_bias_degps: [1, 0, -1], gyro_sample_noise_degps: 4, accel_noise_density_ugrthz: 100, "
      "accel_bias_random_walk_mps3rthz: 0.5, accel_bias_mps2: [0.1, 0.2, 0.3], "
      "accel_sample_noise_mps2: 0.7");
  EXPECT_NEAR(m.gyro_noise_density_radpsrthz, 0.0349066, 1e-7);
  EXPECT_NEAR(m.gyro_bias_random_walk_radps2rthz, 0.0523599, 1e-7);
  EXPECT_NEAR(m.gyro_bias_radps.z(), -0.0174533, 1e-7);
  EXPECT_NEAR(m.gyro_sample_noise_radps, 0.0698132, 1e-7);
  EXPECT_NEAR(m.accel_noise_density_mps2rthz, 9.80665e-4, 1e-12);
  EXPECT_EQ(m.accel_bias_random_walk_mps3rthz, 0.5);
  EXPECT_EQ(m.accel_bias_mps2, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(m.accel_sample_noise_mps2, 0.7);
}

TEST(ReadSensor, GnssKeysReachTheModel) {
  const auto m = ModelOf<GnssModel>(
      "type: gnss, white_horizontal_m: 1, white_vertical_m: 2, correlated_horizontal_m: 3, "
      "correlated_vertical_m: 4, correlation_time_s: 5, bias_enu_m: [6, 7, 8], fix: rtk_float");
  EXPECT_EQ(m.white_horizontal_m, 1);
  EXPECT_EQ(m.white_vertical_m, 2);
  EXPECT_EQ(m.correlated_horizontal_m, 3);
  EXPECT_EQ(m.correlated_vertical_m, 4);
  EXPECT_EQ(m.correlation_time_s, 5);
  EXPECT_EQ(m.bias_enu_m, Vec3(6, 7, 8));
  EXPECT_EQ(m.fix, GnssFix::kRtkFloat);
  EXPECT_EQ(ModelOf<GnssModel>("type: gnss, fix: none").fix, GnssFix::kNone);
  EXPECT_EQ(ModelOf<GnssModel>("type: gnss, fix: single").fix, GnssFix::kSingle);
  EXPECT_EQ(ModelOf<GnssModel>("type: gnss, fix: differential").fix, GnssFix::kDifferential);
}

TEST(ReadSensor, CameraKeysReachTheModel) {
  const auto m = ModelOf<CameraModel>(
      "type: camera, width_px: 100, height_px: 80, fx_px: 90, fy_px: 91, cx_px: 48, cy_px: 41, "
      "k1: 0.1, k2: 0.2, p1: 0.003, p2: 0.004, k3: 0.5, near_m: 0.2, far_m: 50, rgb: false, "
      "depth: true, labels: false, depth_min_m: 0.3, depth_max_m: 9, disparity_noise_px: 0.1, "
      "baseline_m: 0.07, rgb_noise: 3");
  const CameraIntrinsics& c = m.intrinsics;
  EXPECT_EQ(c.width_px, 100);
  EXPECT_EQ(c.height_px, 80);
  EXPECT_EQ(Vec3(c.fx_px, c.fy_px, c.cx_px), Vec3(90, 91, 48));
  EXPECT_EQ(Vec3(c.cy_px, c.k1, c.k2), Vec3(41, 0.1, 0.2));
  EXPECT_EQ(Vec3(c.p1, c.p2, c.k3), Vec3(0.003, 0.004, 0.5));
  EXPECT_EQ(Vec2(c.near_m, c.far_m), Vec2(0.2, 50));
  EXPECT_FALSE(m.rgb);
  EXPECT_TRUE(m.depth);
  EXPECT_TRUE(m.labels.none());
  EXPECT_EQ(Vec2(m.depth_min_m, m.depth_max_m), Vec2(0.3, 9));
  EXPECT_EQ(Vec3(m.disparity_noise_px, m.baseline_m, m.rgb_noise), Vec3(0.1, 0.07, 3));
}

TEST(ReadSensor, ImageSensorKeysReachTheModelAndItsFile) {
  const std::string yaml =
      "{exposure_s: 0.004, f_number: 2.8, transmission: 0.8, pixel_um: 5.5, "
      "quantum_efficiency: [0.41, 0.62, 0.53], full_well_e: 32000, read_noise_e: 6.5, "
      "dark_current_eps: 40, temperature_degc: 50, dark_temperature_degc: 20, dark_doubling_k: 7, "
      "prnu: 0.01, dsnu_e: 3, row_noise_e: 1.5, hot_pixels: 0.001, bits: 10, gain_db: 6, "
      "black_dn: 16, filter: gbrg, rim: {radius_mm: 3.5, distance_mm: 2.5}, "
      "shutter: {readout_s: 0.011, motion_blur: false, step_px: 0.7, most_pictures: 9}}";
  const std::string camera = "type: camera, width_px: 8, height_px: 6, fx_px: 9, image_sensor: ";
  const auto m = ModelOf<CameraModel>(camera + yaml);
  ASSERT_TRUE(m.image_sensor.has_value());
  const std::string file = ModelYaml(*m.image_sensor, 4);
  for (const std::string line : {"exposure_s: 0.004",
                                 "f_number: 2.8",
                                 "transmission: 0.8",
                                 "pixel_um: 5.5",
                                 "quantum_efficiency: [0.41, 0.62, 0.53]",
                                 "full_well_e: 32000",
                                 "read_noise_e: 6.5",
                                 "dark_current_eps: 40",
                                 "temperature_degc: 50",
                                 "dark_temperature_degc: 20",
                                 "dark_doubling_k: 7",
                                 "prnu: 0.01",
                                 "dsnu_e: 3",
                                 "row_noise_e: 1.5",
                                 "hot_pixels: 0.001",
                                 "bits: 10",
                                 "gain_db: 6",
                                 "black_dn: 16",
                                 "filter: gbrg",
                                 "rim:",
                                 "  radius_mm: 3.5",
                                 "  distance_mm: 2.5",
                                 "shutter:",
                                 "  readout_s: 0.011",
                                 "  motion_blur: false",
                                 "  step_px: 0.7",
                                 "  most_pictures: 9"}) {
    EXPECT_NE(file.find("    " + line + "\n"), std::string::npos) << line;
  }
  EXPECT_FALSE(ModelOf<CameraModel>(camera + "{filter: none}").image_sensor->filter.has_value());
  EXPECT_FALSE(ModelOf<CameraModel>("type: camera, width_px: 8, height_px: 6, fx_px: 9")
                   .image_sensor.has_value());
}

TEST(ReadSensor, LabelsAreTheUsualOnesNoneOrThoseOfAList) {
  const auto labels = [](const std::string& keys) {
    return LabelsYaml(
        ModelOf<CameraModel>("type: camera, width_px: 8, height_px: 6, fx_px: 9" + keys).labels);
  };
  EXPECT_EQ(labels(""), "true");
  EXPECT_EQ(labels(", labels: true"), "true");
  EXPECT_EQ(labels(", labels: false"), "false");
  EXPECT_EQ(labels(", labels: [instance, semantic]"), "true");
  EXPECT_EQ(labels(", labels: [normal]"), "[normal]");
  EXPECT_EQ(labels(", labels: [normal, semantic, instance]"), "[semantic, instance, normal]");
}

TEST(ReadSensor, AFieldOfViewSpansTheImageFromEdgeToEdge) {
  // 90 degrees: the left edge of pixel 0, at u = -0.5, lies 45 degrees off the axis.
  const auto m =
      ModelOf<CameraModel>("type: camera, width_px: 640, height_px: 480, horizontal_fov_deg: 90");
  EXPECT_NEAR((m.intrinsics.cx_px + 0.5) / m.intrinsics.fx_px, 1, 1e-12);
  EXPECT_NEAR(m.intrinsics.cy_px, 239.5, 1e-12);
  EXPECT_EQ(m.intrinsics.fx_px, m.intrinsics.fy_px);
}

TEST(ReadSensor, LidarKeysReachTheModelInSiUnits) {
  const auto m = ModelOf<LidarModel>(
      "type: lidar, elevation_deg: [90, 0], azimuth_offset_deg: [0, 180], "
      "firing_offset_us: [0, 20], columns: 100, clockwise: false, min_range_m: 1, max_range_m: 2, "
      "range_noise_m: 0.5, range_at_10_percent_m: 7");
  EXPECT_NEAR(m.elevation_rad[0], kPi / 2, 1e-12);
  EXPECT_NEAR(m.azimuth_offset_rad[1], kPi, 1e-12);
  EXPECT_NEAR(m.firing_offset_s[1], 2e-5, 1e-15);
  EXPECT_EQ(m.columns, 100);
  EXPECT_FALSE(m.clockwise);
  EXPECT_EQ(Vec2(m.min_range_m, m.max_range_m), Vec2(1, 2));
  EXPECT_EQ(Vec2(m.range_noise_m, m.range_at_10_percent_m), Vec2(0.5, 7));
}

TEST(ReadSensor, EncoderKeysReachTheModel) {
  const auto m = std::get<EncoderModel>(
      SensorRead(
          "name: joints, type: encoder, rate_hz: 100, joints: [boom, arm], resolution_deg: 90, "
          "noise_deg: 180, rate_noise_degps: 360, resolution_m: 0.1, noise_m: 0.2, "
          "rate_noise_mps: 0.3")
          .model);
  EXPECT_EQ(m.joints, (std::vector<std::string>{"boom", "arm"}));
  EXPECT_NEAR(m.resolution_rad, kPi / 2, 1e-12);
  EXPECT_NEAR(m.noise_rad, kPi, 1e-12);
  EXPECT_NEAR(m.rate_noise_radps, 2 * kPi, 1e-12);
  EXPECT_EQ(Vec3(m.resolution_m, m.noise_m, m.rate_noise_mps), Vec3(0.1, 0.2, 0.3));
}

TEST(ReadSensor, FaultsSayWhereAndWhatIsNeeded) {
  EXPECT_THAT(SensorFaultOf("name: a, type: imu, link: b, rate_hz: 0"),
              HasSubstr("sensor.rate_hz: 0 is out of range, need more than 0 Hz"));
  EXPECT_THAT(SensorFaultOf("name: a, type: imu, rate_hz: 1"), HasSubstr("sensor.link: missing"));
  EXPECT_THAT(SensorFaultOf("type: imu, link: b, rate_hz: 1"), HasSubstr("sensor.name: missing"));
  EXPECT_THAT(SensorFaultOf("name: a/b, type: imu, link: b, rate_hz: 1"),
              HasSubstr("name 'a/b' cannot name a folder"));
  EXPECT_THAT(SensorFaultOf("name: a, type: radar, link: b, rate_hz: 1"),
              HasSubstr("'radar' is not known, need one of imu"));
  EXPECT_THAT(SensorFaultOf("name: a, type: imu, link: b, rate_hz: 1, latency_s: -1"),
              HasSubstr("latency_s: -1 is out of range"));
  EXPECT_THAT(SensorFaultOf("name: a, type: imu, link: b, rate_hz: 1, gyro_bias_dps: [0, 0, 0]"),
              HasSubstr("unknown key (did you mean 'gyro_bias_degps'?)"));
  EXPECT_THAT(SensorFaultOf("name: e, type: encoder, link: b, rate_hz: 1"),
              HasSubstr("unknown key"));
  EXPECT_THAT(SensorFaultOf("name: e, type: encoder, rate_hz: 1, joints: [boom, arm, boom]"),
              HasSubstr("sensor.joints: 'boom' is named twice; keep one"));
  EXPECT_THAT(SensorFaultOf("name: a, link: b, preset: nowhere.yaml"),
              HasSubstr("file 'nowhere.yaml' does not exist"));
}

TEST(ReadSensor, ModelsThatContradictThemselvesAreRefused) {
  const std::string camera =
      "name: c, type: camera, link: b, rate_hz: 1, width_px: 8, height_px: 8";
  EXPECT_THAT(SensorFaultOf(camera + ", horizontal_fov_deg: 60, fx_px: 3"), HasSubstr("keep one"));
  EXPECT_THAT(SensorFaultOf(camera), HasSubstr("fx_px: missing"));
  EXPECT_THAT(SensorFaultOf(camera + ", fx_px: 3, near_m: 5, far_m: 4"),
              HasSubstr("near_m < far_m"));
  EXPECT_THAT(SensorFaultOf(camera + ", fx_px: 3, depth_min_m: 5, depth_max_m: 4"),
              HasSubstr("depth_min_m < depth_max_m"));
  EXPECT_THAT(SensorFaultOf(camera + ", fx_px: 3, rgb: false, labels: false"),
              HasSubstr("all off"));
  EXPECT_THAT(SensorFaultOf(camera + ", fx_px: 3, labels: [semantic, norml]"),
              AllOf(HasSubstr("labels: 'norml' is no label channel"), HasSubstr("'normal'"),
                    HasSubstr("need some of semantic, instance, normal")));
  EXPECT_THAT(SensorFaultOf(camera + ", fx_px: 3, labels: normal"),
              HasSubstr("need a list, [normal]"));
  const std::string lidar = "name: l, type: lidar, link: b, rate_hz: 10, elevation_deg: [1, 2]";
  EXPECT_THAT(SensorFaultOf(lidar + ", columns: 10, azimuth_offset_deg: [1]"),
              HasSubstr("need a list of 2 numbers"));
  EXPECT_THAT(SensorFaultOf(lidar + ", columns: 10, min_range_m: 3, max_range_m: 2"),
              HasSubstr("min_range_m < max_range_m"));
  EXPECT_THAT(SensorFaultOf(lidar + ", columns: 1000, firing_offset_us: [0, 101]"),
              HasSubstr("a column at rate_hz 10 with 1000 columns lasts 100 us"));
}

TEST(SensorYaml, StatesPlaceRateAndModel) {
  const std::string text = SensorYaml(
      SensorRead("name: imu_boom, type: imu, link: boom, xyz_m: [1, 2, 3], rpy_deg: [0, 0, 90], "
                 "rate_hz: 200, latency_s: 0.025, gyro_noise_density_degpsrthz: 0.007"));
  EXPECT_THAT(text, HasSubstr("type: imu\n"));
  EXPECT_THAT(text, HasSubstr("parent_link: boom\n"));
  EXPECT_THAT(text, HasSubstr("xyz_m: [1, 2, 3]\n"));
  EXPECT_THAT(text, HasSubstr("rate_hz: 200\n"));
  EXPECT_THAT(text, HasSubstr("latency_s: 0.025\n"));
  EXPECT_THAT(text, HasSubstr("  gyro_noise_density_degpsrthz: 0.007\n"));
}

TEST(SensorYaml, ItsModelReadsBackToTheSameModel) {
  for (const std::string preset :
       {"xsens_mti_670", "rtk_f9p", "realsense_d435i", "os1_64", "vlp16", "encoder"}) {
    const std::string link = preset == "encoder" ? "" : "link: upper, ";
    const SensorDescription sensor =
        SensorRead("name: s, " + link + "preset: 'tera:config/sensors/" + preset + ".yaml'");
    const std::string text = SensorYaml(sensor);
    const Config config = Config::FromText(text, "sensor.yaml");
    const ConfigMap model = config.root().Map("model");
    SensorDescription again = sensor;
    KindOf(sensor).read(model, &again);
    EXPECT_EQ(SensorYaml(again), text);
  }
}

}  // namespace
}  // namespace tera
