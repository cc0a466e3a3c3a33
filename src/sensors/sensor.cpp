#include "sensors/sensor.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/config/config_faults.h"
#include "core/config/plain_name.h"
#include "core/types/mounting.h"
#include "core/units.h"
#include "sensors/slots/true_mount.h"

namespace tera {
namespace {

/// Beyond what any sensor of these kinds puts out, and far from a period of less than a nanosecond.
constexpr double kFastest_hz = 1e5;

constexpr std::string_view kTypes[] = {"imu", "gnss", "camera", "lidar", "encoder"};

void CheckFirings(const ConfigMap& config, const LidarModel& lidar, const SampleClock& clock) {
  const double column_s = 1.0 / (clock.rate_hz * lidar.columns);
  const double last_s =
      *std::max_element(lidar.firing_offset_s.begin(), lidar.firing_offset_s.end());
  if (last_s < column_s) return;
  config.Fault("firing_offset_us",
               fmt::format("last firing at {} us but a column at rate_hz {} with {} columns lasts "
                           "{} us; need a shorter offset, fewer columns or a lower rate",
                           last_s * 1e6, clock.rate_hz, lidar.columns, column_s * 1e6));
}

std::string List(const std::vector<double>& values, double unit = 1.0) {
  std::vector<double> scaled = values;
  for (double& v : scaled) v /= unit;
  return fmt::format("[{:.12g}]", fmt::join(scaled, ", "));
}

std::string List(const Vec3& v, double unit = 1.0) {
  return fmt::format("[{:.12g}, {:.12g}, {:.12g}]", v.x() / unit, v.y() / unit, v.z() / unit);
}

std::string ModelYaml(const ImuModel& m) {
  return fmt::format(
      "  gyro_noise_density_degpsrthz: {:.12g}\n  gyro_bias_random_walk_degps2rthz: {:.12g}\n"
      "  gyro_bias_degps: {}\n  gyro_sample_noise_degps: {:.12g}\n"
      "  accel_noise_density_ugrthz: {:.12g}\n  accel_bias_random_walk_mps3rthz: {}\n"
      "  accel_bias_mps2: {}\n  accel_sample_noise_mps2: {}\n",
      m.gyro_noise_density_radpsrthz / kDeg, m.gyro_bias_random_walk_radps2rthz / kDeg,
      List(m.gyro_bias_radps, kDeg), m.gyro_sample_noise_radps / kDeg,
      m.accel_noise_density_mps2rthz / kMicroG_mps2, m.accel_bias_random_walk_mps3rthz,
      List(m.accel_bias_mps2), m.accel_sample_noise_mps2);
}

std::string ModelYaml(const GnssModel& m) {
  return fmt::format(
      "  fix: {}\n  white_horizontal_m: {}\n  white_vertical_m: {}\n"
      "  correlated_horizontal_m: {}\n  correlated_vertical_m: {}\n  correlation_time_s: {}\n"
      "  bias_enu_m: {}\n",
      NameOf(m.fix), m.white_horizontal_m, m.white_vertical_m, m.correlated_horizontal_m,
      m.correlated_vertical_m, m.correlation_time_s, List(m.bias_enu_m));
}

std::string ModelYaml(const CameraModel& m) {
  const CameraIntrinsics& c = m.intrinsics;
  return fmt::format(
      "  width_px: {}\n  height_px: {}\n  fx_px: {}\n  fy_px: {}\n  cx_px: {}\n  cy_px: {}\n"
      "  k1: {}\n  k2: {}\n  p1: {}\n  p2: {}\n  k3: {}\n  near_m: {}\n  far_m: {}\n"
      "  rgb: {}\n  depth: {}\n  labels: {}\n  depth_min_m: {}\n  depth_max_m: {}\n"
      "  disparity_noise_px: {}\n  baseline_m: {}\n  rgb_noise: {}\n",
      c.width_px, c.height_px, c.fx_px, c.fy_px, c.cx_px, c.cy_px, c.k1, c.k2, c.p1, c.p2, c.k3,
      c.near_m, c.far_m, m.rgb, m.depth, m.labels, m.depth_min_m, m.depth_max_m,
      m.disparity_noise_px, m.baseline_m, m.rgb_noise);
}

std::string ModelYaml(const LidarModel& m) {
  constexpr double kMicrosecond = 1e-6;
  return fmt::format(
      "  elevation_deg: {}\n  azimuth_offset_deg: {}\n  firing_offset_us: {}\n  columns: {}\n"
      "  clockwise: {}\n  min_range_m: {}\n  max_range_m: {}\n  range_noise_m: {}\n"
      "  range_at_10_percent_m: {}\n",
      List(m.elevation_rad, kDeg), List(m.azimuth_offset_rad, kDeg),
      List(m.firing_offset_s, kMicrosecond), m.columns, m.clockwise, m.min_range_m, m.max_range_m,
      m.range_noise_m, m.range_at_10_percent_m);
}

std::string ModelYaml(const EncoderModel& m) {
  return fmt::format(
      "  joints: [{}]\n  resolution_deg: {:.12g}\n  noise_deg: {:.12g}\n  rate_noise_degps: "
      "{:.12g}\n  resolution_m: {}\n  noise_m: {}\n  rate_noise_mps: {}\n",
      fmt::join(m.joints, ", "), m.resolution_rad / kDeg, m.noise_rad / kDeg,
      m.rate_noise_radps / kDeg, m.resolution_m, m.noise_m, m.rate_noise_mps);
}

}  // namespace

std::string TypeOf(const SensorDescription& sensor) {
  return std::string(kTypes[sensor.model.index()]);
}

SensorDescription ReadSensor(const ConfigMap& config) {
  SensorDescription s;
  s.name = config.Text("name");
  RequirePlainName(config, "name", s.name);
  config.ApplyPreset("preset");
  const std::string type =
      ChoiceOfKeys(config, "type", {"imu", "gnss", "camera", "lidar", "encoder"});
  if (IsUnread(config)) return s;
  if (type != "encoder") {
    s.link = config.Text("link");
    s.X_BS = config.PoseXyzRpy();
  }
  const bool lidar = type == "lidar";
  s.clock.rate_hz = config.Number("rate_hz", {.min = lidar ? Lidar::kSlowest_hz : 0,
                                              .max = kFastest_hz,
                                              .min_excluded = !lidar,
                                              .unit = "Hz"});
  s.latency_ns = FromSeconds(config.Number("latency_s", AtLeast(0, "s"), 0));
  if (type == "imu") {
    s.model = ReadImuModel(config);
  } else if (type == "gnss") {
    s.model = ReadGnssModel(config);
  } else if (type == "camera") {
    s.model = ReadCameraModel(config);
  } else if (lidar) {
    const LidarModel model = ReadLidarModel(config);
    CheckFirings(config, model, s.clock);
    s.model = model;
  } else {
    s.model = ReadEncoderModel(config);
  }
  return s;
}

const SensorDescription* OtherAntenna(const SensorDescription& sensor,
                                      const std::vector<SensorDescription>& sensors) {
  const SensorDescription* other = nullptr;
  for (const SensorDescription& s : sensors) {
    if (!std::holds_alternative<GnssModel>(s.model) || s.name == sensor.name) continue;
    if (other) return nullptr;
    other = &s;
  }
  return other;
}

Mounting TrueMounting(const SensorDescription& sensor,
                      const std::vector<SensorDescription>& sensors) {
  const auto antenna = [](const SensorDescription& s) {
    return Antenna{s.link, s.X_BS, s.effects};
  };
  const SensorDescription* other =
      std::holds_alternative<GnssModel>(sensor.model) ? OtherAntenna(sensor, sensors) : nullptr;
  if (!other) return {sensor.link, TrueMount(sensor.X_BS, sensor.effects)};
  const AntennaPlace place = TrueAntenna(antenna(sensor), antenna(*other));
  return {place.link, place.X_BT};
}

std::string SensorYaml(const SensorDescription& sensor) {
  std::string text = fmt::format("type: {}\nname: {}\n", TypeOf(sensor), sensor.name);
  if (!sensor.link.empty()) text += MountingYaml(sensor.link, sensor.X_BS);
  text += fmt::format("rate_hz: {}\nlatency_s: {:.12g}\nmodel:\n", sensor.clock.rate_hz,
                      ToSeconds(sensor.latency_ns));
  return text + std::visit([](const auto& model) { return ModelYaml(model); }, sensor.model);
}

}  // namespace tera
