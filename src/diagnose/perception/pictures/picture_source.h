#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "resimulate/sensor_calibration.h"
#include "resimulate/simulated_return.h"

/// Pictures of a recorded colour camera, and their simulation.

namespace tera {

/// Pictures of one camera with their simulation.
///
/// Frames  W; B the camera's link; S the sensor as documented; C optical.
struct PictureSource {
  std::string channel;  ///< "excavator1/camera_mast"
  std::string target;   ///< the camera's name in the scenario
  EffectTarget kind = EffectTarget::kCamera;
  Pose X_BS = Pose::Identity();
  Pose X_SC = Pose::Identity();
  Effects present;  ///< of the camera, as the scenario has them
  std::vector<TimeNs> t_ns;
  std::vector<Image<float>> grey;  ///< measured, 0 to 1
  /// The picture of a frame under a possible calibration of the camera; nothing if the camera's
  /// pose at that time is unknown.
  std::function<std::optional<SimulatedPicture>(std::size_t frame,
                                                const SensorCalibration& calibration)>
      render;
  /// Motion of the link at the frame's true time.
  std::function<std::optional<BodyState>(std::size_t frame, const SensorCalibration& calibration)>
      link_at;
  std::function<Vec2(const Vec3& p_C_m)> project;          ///< pixel of a point in front of the
                                                           ///< camera
  std::function<std::optional<Vec3>(const Vec2& px)> ray;  ///< (x, y, 1) of a pixel

  /// The scenario's calibration.
  SensorCalibration calibration() const { return CalibrationUnder(X_BS, present); }
};

}  // namespace tera
