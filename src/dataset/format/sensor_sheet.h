#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/motion.h"
#include "core/time.h"

namespace tera {

class ConfigMap;

/// Image size and lens of a camera, as in docs/reference/dataset.md. The centre of pixel (0, 0) has
/// image coordinates (0, 0).
struct CameraLens {
  std::string law = "brown_conrady";  ///< or `rational`, `kannala_brandt`, `f_theta`
  int width_px = 0, height_px = 0;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  double k4 = 0, k5 = 0, k6 = 0;
};

/// White noise of an IMU, equal on all axes.
///
/// Model   A sample over the period T has the variance density^2 / T + sample^2.
struct ImuNoise {
  double gyro_density_radpsrthz = 0, gyro_sample_radps = 0;
  double accel_density_mps2rthz = 0, accel_sample_mps2 = 0;
};

/// Content of a sensor.yaml. Keys may be absent for a real sensor.
struct SensorSheet {
  std::string type, name;
  std::string parent_link;   ///< empty: unknown or none
  std::optional<Pose> X_PS;  ///< pose of the sensor in the parent link
  double rate_hz = 0;        ///< 0: unknown
  TimeNs latency_ns = 0;
  std::optional<CameraLens> lens;
  int lidar_rays = 0;  ///< rays per scan; 0: unknown
  std::optional<ImuNoise> imu_noise;
};

/// Reads the key `model` of a camera, as in sensor.yaml. Faults are reported at `model`.
CameraLens ReadCameraLens(const ConfigMap& model);

/// Throws InputError if the file is missing or deviates from docs/reference/dataset.md.
SensorSheet ReadSensorSheet(const std::filesystem::path& sensor_folder);

}  // namespace tera
