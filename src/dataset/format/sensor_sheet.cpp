#include "dataset/format/sensor_sheet.h"

#include <cmath>
#include <vector>

#include "core/config/config.h"
#include "core/config/config_faults.h"
#include "core/units.h"
#include "dataset/format/channel.h"

namespace tera {
namespace {

constexpr double kMostPixels = 65535;

Pose ReadPlace(const ConfigMap& map) {
  const std::vector<double> q = map.Numbers("quaternion_wxyz", Between(-1, 1, ""), 4, 4);
  const Vec3 p_m = map.Vector3("xyz_m", Any("m"));
  if (q.size() != 4) return Pose::Identity();
  const Quat rotation(q[0], q[1], q[2], q[3]);
  if (std::abs(rotation.norm() - 1) > kQuaternionTolerance) {
    map.Fault("quaternion_wxyz", {FaultKind::kMalformed, "need a quaternion of norm 1"});
    return Pose::Identity();
  }
  return MakePose(p_m, rotation.normalized().toRotationMatrix());
}

/// Number of rays: beams times columns, if the scan pattern defines both.
int ReadLidarRays(const ConfigMap& model) {
  constexpr double kMostColumns = 100'000;
  constexpr std::size_t kMostBeams = 1024;
  if (!model.Has("columns") || !model.Has("elevation_deg")) return 0;
  const auto columns = static_cast<int>(model.Integer("columns", Between(1, kMostColumns, "")));
  return columns *
         static_cast<int>(
             model.Numbers("elevation_deg", Between(-90, 90, "deg"), 1, kMostBeams).size());
}

ImuNoise ReadImuNoise(const ConfigMap& model) {
  const auto number = [&](const char* key) { return model.Number(key, AtLeast(0, ""), 0); };
  return {kDeg * number("gyro_noise_density_degpsrthz"), kDeg * number("gyro_sample_noise_degps"),
          kMicroG_mps2 * number("accel_noise_density_ugrthz"), number("accel_sample_noise_mps2")};
}

}  // namespace

CameraLens ReadCameraLens(const ConfigMap& model) {
  CameraLens lens;
  lens.width_px = static_cast<int>(model.Integer("width_px", Between(1, kMostPixels, "px")));
  lens.height_px = static_cast<int>(model.Integer("height_px", Between(1, kMostPixels, "px")));
  lens.fx_px = model.Number("fx_px", Positive("px"));
  lens.fy_px = model.Number("fy_px", Positive("px"));
  lens.cx_px = model.Number("cx_px", Any("px"));
  lens.cy_px = model.Number("cy_px", Any("px"));
  lens.law = model.Choice("lens", {"brown_conrady", "rational", "kannala_brandt", "f_theta"},
                          "brown_conrady");
  lens.k1 = model.Number("k1", Any(""), 0);
  lens.k2 = model.Number("k2", Any(""), 0);
  lens.p1 = model.Number("p1", Any(""), 0);
  lens.p2 = model.Number("p2", Any(""), 0);
  lens.k3 = model.Number("k3", Any(""), 0);
  lens.k4 = model.Number("k4", Any(""), 0);
  lens.k5 = model.Number("k5", Any(""), 0);
  lens.k6 = model.Number("k6", Any(""), 0);
  return lens;
}

SensorSheet ReadSensorSheet(const std::filesystem::path& sensor_folder) {
  const Config config = Config::FromFile(sensor_folder / "sensor.yaml");
  const ConfigMap root = config.root();
  SensorSheet sheet;
  sheet.type = root.Text("type", "");
  sheet.name = root.Text("name", sensor_folder.filename().string());
  sheet.parent_link = root.Text("parent_link", "");
  if (root.Has("X_parent_sensor")) sheet.X_PS = ReadPlace(root.Map("X_parent_sensor"));
  sheet.rate_hz = root.Number("rate_hz", AtLeast(0, "Hz"), 0);
  sheet.latency_ns = FromSeconds(root.Number("latency_s", AtLeast(0, "s"), 0));
  if (root.Has("model")) {
    const ConfigMap model = root.Map("model");
    if (model.Has("fx_px")) sheet.lens = ReadCameraLens(model);
    if (sheet.type == kLidarChannel) sheet.lidar_rays = ReadLidarRays(model);
    if (sheet.type == kImuChannel) sheet.imu_noise = ReadImuNoise(model);
  }
  // Other programs may read further keys. Unknown keys are therefore reported only together with a
  // fault in the requested keys.
  if (FaultCount(root) > 0) config.Finish();
  return sheet;
}

}  // namespace tera
