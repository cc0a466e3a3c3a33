#pragma once

#include <vector>

#include "render/gl/rasterizer.h"
#include "resimulate/recorded_stage.h"
#include "resimulate/scan_caster.h"
#include "resimulate/simulated_return.h"
#include "sensors/sensor.h"

namespace tera {

/// Renders what a camera would have seen from the recorded trajectory.
///
/// Frames  W of the recorded poses; B the camera's link; T the camera as a calibration has it;
///         C optical.
/// Model   bodies, link and ground at one instant, that of the picture; the simulator's own camera
///         without noise, `reduced` times smaller in both directions.
/// Omits   what the simulator's camera omits (sensors/camera/camera.h); what tracks and shovels
/// look like,
///         whose pixels are marked as not to be compared.
class PictureCaster {
 public:
  /// Keeps references to all. Throws InputError where there is no OpenGL.
  PictureCaster(const Scenario& scenario, const SceneAssembly& assembly, const RecordedStage& stage,
                const std::vector<RecordedMotion>& machines);

  /// Motion of the camera's link at the true time of a picture; nothing where it is not known.
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
  std::vector<Surface> surface_;  ///< of each instance
  Rasterizer rasterizer_;
};

/// The lens of a picture so many times smaller both ways, each pixel the mean of what it covers.
CameraIntrinsics Reduced(const CameraIntrinsics& lens, int times);
/// The brightness of a picture (Rec. 601) from 0 to 1, so many times smaller.
Image<float> ReducedGrey(const Image<std::uint8_t>& rgb, int times);

}  // namespace tera
