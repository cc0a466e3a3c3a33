#pragma once

#include <vector>

#include "render/gl/rasterizer.h"
#include "resimulate/recorded_stage.h"
#include "resimulate/scan_caster.h"
#include "resimulate/simulated_return.h"
#include "sensors/sensor.h"

namespace tera {

/// Renders what a camera would see along the recorded trajectory.
///
/// Frames  W of the recorded poses; B the camera's link; T the calibrated camera; C optical.
/// Model   bodies and ground have their state at the image's time. The camera is the simulator's
///         own without noise. The image is reduced by the factor `reduced` along both axes.
/// Omits   as the simulator's camera (sensors/camera/camera.h). Also the appearance of tracks and
///         of the soil in shovels; their pixels are marked as not comparable.
class PictureCaster {
 public:
  /// Keeps references to all arguments. Throws InputError if OpenGL is not available.
  PictureCaster(const Scenario& scenario, const SceneAssembly& assembly, const RecordedStage& stage,
                const std::vector<RecordedMotion>& machines);

  /// Motion of the camera's link at the true time of an image. Empty if it is unknown.
  std::optional<BodyState> LinkAt(std::size_t machine, const SensorDescription& sensor,
                                  const ScanCaster::Scan& picture,
                                  const SensorCalibration& calibration) const;
  std::optional<SimulatedPicture> Render(std::size_t machine, const SensorDescription& sensor,
                                         const ScanCaster::Scan& picture,
                                         const SensorCalibration& calibration, int reduced);

 private:
  const Scenario& scenario_;
  const SceneAssembly& assembly_;
  const RecordedStage& stage_;
  const std::vector<RecordedMotion>& machines_;
  std::vector<Surface> surface_;  ///< one per instance
  Rasterizer rasterizer_;
};

/// Lens of an image that is reduced by the factor `times` along both axes. Each reduced pixel is
/// the mean of `times` x `times` pixels.
CameraIntrinsics Reduced(const CameraIntrinsics& lens, int times);
/// Brightness of an image (Rec. 601) in [0, 1], reduced by the factor `times` along both axes.
Image<float> ReducedGrey(const Image<std::uint8_t>& rgb, int times);

}  // namespace tera
