#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "render/hand_made_scene.h"
#include "sensors/sensor.h"

// Every key of a sensor changes its output, from the YAML to the measurement. (Cameras:
// camera_test.cpp; name, link, xyz_m, rpy_deg and joints: test/sim.)

namespace tera {
namespace {

using testing::CubeMesh;
using testing::NoGround;
using testing::OneBodyEach;

/// All measurements of a sensor, in order.
using Output = std::vector<double>;

void Append(const Vec3& v, Output* output) { output->insert(output->end(), {v.x(), v.y(), v.z()}); }

SensorDescription Read(const std::string& keys) {
  const Config config = Config::FromText("sensor: {name: s, " + keys + "}", "rig.yaml");
  const SensorDescription sensor = ReadSensor(config.root().Map("sensor"));
  config.Finish();
  return sensor;
}

constexpr TimeNs kStep_ns = 2'000'000;

/// A body that drives a circle for half a second.
std::vector<ImuSample> ImuSamples(const SensorDescription& s) {
  Imu imu(std::get<ImuModel>(s.model), s.X_BS, s.clock, s.latency_ns, 1, "m/s");
  const auto at = [](int step) {
    BodyState body;
    body.X_WB =
        MakePose({3 * std::cos(0.004 * step), 3 * std::sin(0.004 * step), 1}, 0, 0, 0.004 * step);
    return body;
  };
  std::vector<ImuSample> samples;
  for (int k = 0; k < 250; ++k) {
    imu.Advance(k * kStep_ns, at(k), (k + 1) * kStep_ns, at(k + 1), Vec3(0, 0, -9.8), &samples);
  }
  imu.Finish(&samples);
  return samples;
}

std::vector<GnssSample> GnssSamples(const SensorDescription& s) {
  const SiteFrame site(46.8, -71.3, 90);
  Gnss gnss(std::get<GnssModel>(s.model), s.clock, s.latency_ns, 1, "m/s");
  std::vector<GnssSample> samples;
  for (int k = 0; k < 5; ++k) samples.push_back(gnss.Measure(k, Vec3(1, 2, 3), site));
  return samples;
}

std::vector<EncoderSample> EncoderSamples(const SensorDescription& s) {
  const Encoder encoder(std::get<EncoderModel>(s.model), s.clock, s.latency_ns, 1, "m/s");
  return {encoder.Measure(0, {0.3, -0.7}, {0.1, 0.2}), encoder.Measure(1, {0.31, -0.6}, {0, 2})};
}

/// A revolution in a room of 12 m with walls of 40 %, off its middle.
LidarScan FirstScan(const SensorDescription& s) {
  RayScene scene(OneBodyEach({CubeMesh(6)}));
  scene.Update({{Pose::Identity()}}, NoGround());
  PoseTrack track;
  track.Append(0, MakePose({1, 2, 0.5}, 0.1, 0.2, 0.3));
  return Lidar(std::get<LidarModel>(s.model), s.clock, s.latency_ns, 1, "m/s")
      .Measure(0, track, scene, 1);
}

Output OutputOf(const std::string& keys) {
  const SensorDescription s = Read(keys);
  Output out;
  if (TypeOf(s) == "imu") {
    for (const ImuSample& sample : ImuSamples(s)) {
      out.push_back(static_cast<double>(sample.t_ns));
      Append(sample.w_WS_S_radps, &out);
      Append(sample.f_S_mps2, &out);
    }
  } else if (TypeOf(s) == "gnss") {
    for (const GnssSample& sample : GnssSamples(s)) {
      out.insert(out.end(), {static_cast<double>(sample.t_ns), sample.lat_deg, sample.lon_deg,
                             sample.alt_m, static_cast<double>(sample.fix)});
      Append(sample.enu_m, &out);
      Append(sample.variance_enu_m2, &out);
    }
  } else if (TypeOf(s) == "encoder") {
    for (const EncoderSample& sample : EncoderSamples(s)) {
      out.push_back(static_cast<double>(sample.t_ns));
      out.insert(out.end(), sample.q_rad.begin(), sample.q_rad.end());
      out.insert(out.end(), sample.qd_radps.begin(), sample.qd_radps.end());
    }
  } else {
    for (const LidarPoint& p : FirstScan(s).points) {
      out.insert(out.end(),
                 {p.x_m, p.y_m, p.z_m, p.intensity, double(p.time_offset_ns), double(p.ring)});
    }
  }
  return out;
}

/// Each of `changes`, added to `keys`, must change the output.
void ExpectEachChanges(const std::string& keys, const std::vector<std::string>& changes) {
  const Output plain = OutputOf(keys);
  ASSERT_FALSE(plain.empty());
  ASSERT_EQ(plain, OutputOf(keys));
  for (const std::string& change : changes) EXPECT_NE(plain, OutputOf(keys + change)) << change;
}

TEST(SensorKeys, OfAnImuChangeItsSamples) {
  const std::string keys = "type: imu, link: b";
  ExpectEachChanges(
      keys + ", rate_hz: 100",
      {", gyro_noise_density_degpsrthz: 0.01", ", gyro_bias_random_walk_degps2rthz: 0.01",
       ", gyro_bias_degps: [0, 0.1, 0]", ", gyro_sample_noise_degps: 0.1",
       ", accel_noise_density_ugrthz: 60", ", accel_bias_random_walk_mps3rthz: 0.01",
       ", accel_bias_mps2: [0, 0, 0.1]", ", accel_sample_noise_mps2: 0.1", ", xyz_m: [0, 1, 0]",
       ", rpy_deg: [0, 10, 0]"});
  EXPECT_NE(OutputOf(keys + ", rate_hz: 100"), OutputOf(keys + ", rate_hz: 101"));
}

TEST(SensorKeys, OfAGnssChangeItsFixes) {
  const std::string keys = "type: gnss, link: b";
  ExpectEachChanges(
      keys + ", rate_hz: 10",
      {", white_horizontal_m: 0.1", ", white_vertical_m: 0.1", ", correlated_horizontal_m: 0.1",
       ", correlated_vertical_m: 0.1", ", bias_enu_m: [0, 1, 0]", ", fix: single", ", fix: none"});
  ExpectEachChanges(keys + ", rate_hz: 10, correlated_vertical_m: 0.1",
                    {", correlation_time_s: 5"});
  EXPECT_NE(OutputOf(keys + ", rate_hz: 10"), OutputOf(keys + ", rate_hz: 11"));
}

TEST(SensorKeys, OfEncodersChangeTheirReadings) {
  const std::string keys = "type: encoder";
  ExpectEachChanges(keys + ", rate_hz: 50",
                    {", resolution_deg: 0.1", ", noise_deg: 0.1", ", rate_noise_degps: 0.1"});
  EXPECT_NE(OutputOf(keys + ", rate_hz: 50"), OutputOf(keys + ", rate_hz: 51"));
}

TEST(SensorKeys, OfALidarChangeItsScan) {
  const std::string keys = "type: lidar, link: b, elevation_deg: [5, -5]";
  ExpectEachChanges(keys + ", rate_hz: 10, columns: 90",
                    {", azimuth_offset_deg: [0, 3]", ", firing_offset_us: [0, 20]",
                     ", clockwise: false", ", min_range_m: 5", ", max_range_m: 6",
                     ", range_noise_m: 0.01", ", range_at_10_percent_m: 4"});
  EXPECT_NE(OutputOf(keys + ", rate_hz: 10, columns: 90"),
            OutputOf(keys + ", rate_hz: 10, columns: 91"));
  EXPECT_NE(OutputOf(keys + ", rate_hz: 10, columns: 90"),
            OutputOf(keys + ", rate_hz: 11, columns: 90"));
  EXPECT_NE(OutputOf(keys + ", rate_hz: 10, columns: 90"),
            OutputOf("type: lidar, link: b, elevation_deg: [5, -6], rate_hz: 10, columns: 90"));
}

TEST(SensorKeys, TheLatencyIsTheTimeFromAMeasurementToItsAvailability) {
  const std::string late = ", rate_hz: 10, latency_s: 0.025";
  for (const ImuSample& sample : ImuSamples(Read("type: imu, link: b" + late))) {
    EXPECT_EQ(sample.t_available_ns - sample.t_ns, 25'000'000);
  }
  for (const GnssSample& sample : GnssSamples(Read("type: gnss, link: b" + late))) {
    EXPECT_EQ(sample.t_available_ns - sample.t_ns, 25'000'000);
  }
  for (const EncoderSample& sample : EncoderSamples(Read("type: encoder" + late))) {
    EXPECT_EQ(sample.t_available_ns - sample.t_ns, 25'000'000);
  }
  // A scan's time is that of its first ray; it is complete a revolution later.
  const LidarScan scan =
      FirstScan(Read("type: lidar, link: b, elevation_deg: [0], columns: 8" + late));
  EXPECT_EQ(scan.t_available_ns - scan.t_ns, 125'000'000);
}

}  // namespace
}  // namespace tera
