#pragma once

#include <cstdint>

#include "core/motion.h"
#include "core/time.h"
#include "core/types/measurement.h"

namespace tera {

/// Kind of surface that a ray or pixel hits in the simulation.
enum class Surface {
  kUnknown,  ///< not comparable, because the sensor's pose or the surface's shape is unknown
  kNothing,
  kGround,
  kObstacle,
  kMachine
};

/// True if measurements of this kind of surface can be compared.
inline bool IsComparable(Surface surface) {
  return surface == Surface::kGround || surface == Surface::kObstacle ||
         surface == Surface::kMachine;
}

/// First hit of a ray in the simulated scene.
///
/// Frames  W; B is the sensor's link at the time of the ray.
struct SimulatedReturn {
  Surface surface = Surface::kUnknown;
  int object = 0;  ///< identifies the obstacle or machine part
  double range_m = 0;
  Vec3 normal_W = Vec3::Zero();  ///< unit vector, on the sensor's side
  Pose X_WB = Pose::Identity();
  Vec3 v_WB_mps = Vec3::Zero(), w_WB_radps = Vec3::Zero();
};

/// A ray of a scan: along the unit vector `d_S` from the sensor, `since_ns` after the time stamp of
/// the scan.
struct Beam {
  Vec3 d_S = Vec3::UnitX();
  TimeNs since_ns = 0;
};

/// A simulated image.
struct SimulatedPicture {
  Image<float> grey;     ///< in [0, 1], sRGB-encoded
  Image<float> depth_m;  ///< along the optical axis; 0 without a surface, as in the sky
  /// Values of Surface; kMachine is taken to move with the camera's link.
  Image<std::uint8_t> surface;
};

}  // namespace tera
