#pragma once

#include <filesystem>

#include "core/random.h"

namespace tera::blind::mujoco {

/// Ground under a machine: a plane, with or without three waves.
///
/// Frames  W, z = Height_m(x, y); 0 at the origin where it is a plane.
struct Ground {
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< dz/dx, dz/dy
  bool has_waves = false;
  struct Wave {
    double height_m = 0, x_radpm = 0, y_radpm = 0, phase_rad = 0;
  };
  std::array<Wave, 3> waves{};

  double Height_m(double x_m, double y_m) const;
  Vec3 Normal(double x_m, double y_m) const;  ///< upwards, of length 1
  /// Attitude of a machine on the ground, with its nose towards `yaw_rad`.
  Quat AttitudeAt(double x_m, double y_m, double yaw_rad) const;
};

/// Origin of the owner's survey, on a central meridian of UTM, where grid east is true east.
inline constexpr double kLatitude_deg = 47.4, kLongitude_deg = 9, kHeight_m = 430;

/// Writes the ground as the owner has it: pixels of 0.25 m, `half_m` to each side of the origin,
/// ellipsoidal heights in m, UTM 32 N.
void WriteGeoTiff(const Ground& ground, double half_m, const std::filesystem::path& file);

}  // namespace tera::blind::mujoco
