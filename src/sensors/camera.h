#pragma once

#include <cstdint>
#include <string>

#include "core/config.h"
#include "core/measurement.h"
#include "core/random.h"
#include "render/rasterizer.h"

namespace tera {

/// Colour, depth and label camera.
struct CameraModel {
  CameraIntrinsics intrinsics;
  bool rgb = true;
  bool depth = false;
  bool labels = true;  ///< semantic, instance, boxes
  double depth_min_m = 0.1, depth_max_m = 20.0;
  /// Disparity noise of the depth camera: sigma_z = z^2 sigma_d / (f b); 0 switches it off.
  double disparity_noise_px = 0, baseline_m = 0.05;
  double rgb_noise = 0;  ///< 1 sigma of the sRGB value in 0..255 (photometry comes later)
};

CameraModel ReadCameraModel(const ConfigMap& config);

/// Pose of the optical frame C in the sensor frame S: z of C is x of S, x of C is -y of S.
Pose OpticalInSensor();

class Camera {
 public:
  Camera(const CameraModel& model, const SampleClock& clock, TimeNs latency_ns, std::uint64_t seed,
         const std::string& stream_name);
  /// Exposure k of the scene with the sensor at X_WS.
  CameraFrame Measure(std::int64_t k, const Pose& X_WS, const SceneState& scene,
                      Rasterizer* rasterizer) const;
  const CameraModel& model() const { return model_; }

 private:
  CameraModel model_;
  SampleClock clock_;
  TimeNs latency_ns_;
  Stream depth_noise_, rgb_noise_;
};

}  // namespace tera
