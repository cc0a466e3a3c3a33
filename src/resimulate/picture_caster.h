#pragma once

#include <vector>

#include "render/gl/rasterizer.h"
#include "resimulate/recorded_stage.h"
#include "resimulate/scan_caster.h"
#include "resimulate/simulated_return.h"
#include "sensors/sensor.h"

namespace tera {

/// Renders a camera's view along the recorded trajectory.
///
/// Frames  W of the recorded poses; B the camera's link; T the calibrated camera; C optical.
/// Model   bodies, link and ground at the image's instant; the simulator's own camera without
///         noise, reduced `reduced` times in both directions.
/// Omits   the omissions of the simulator's camera (sensors/camera/camera.h); appearance of tracks
///         and shovels, whose pixels are marked as not comparable.
class PictureCaster {
 public:
  /// Keeps references to all arguments. Throws InputError without OpenGL.
  PictureCaster(const Scenario& scenario, const SceneAssembly& assembly, const RecordedStage& stage,
                const std::vector<RecordedMotion>& machines);

  /// Motion of the camera's link at an image's true time; nullopt if unknown.
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

/// Lens of an image reduced `times` in both directions; each reduced pixel is a mean.
CameraIntrinsics Reduced(const CameraIntrinsics& lens, int times);
/// Brightness of an image (Rec. 601) from 0 to 1, reduced `times` in both directions.
Image<float> ReducedGrey(const Image<std::uint8_t>& rgb, int times);

}  // namespace tera
