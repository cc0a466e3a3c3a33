#pragma once

#include <cstdint>

#include "core/motion.h"
#include "core/time.h"
#include "core/types/measurement.h"

namespace tera {

/// Surface that a ray or pixel meets in the simulation.
enum class Surface {
  kUnknown,  ///< not comparable: unknown sensor pose or unknown shape
  kNothing,
  kGround,
  kObstacle,
  kMachine
};

/// True if a measurement of the surface is comparable.
inline bool IsComparable(Surface surface) {
  return surface == Surface::kGround || surface == Surface::kObstacle ||
         surface == Surface::kMachine;
}

/// First intersection of a ray with the simulated scene.
///
/// Frames  W; B the sensor's link at the ray's own time.
struct SimulatedReturn {
  Surface surface = Surface::kUnknown;
  int object = 0;  ///< distinguishes obstacles and machine parts
  double range_m = 0;
  Vec3 normal_W = Vec3::Zero();  ///< unit vector, towards the sensor
  Pose X_WB = Pose::Identity();
  Vec3 v_WB_mps = Vec3::Zero(), w_WB_radps = Vec3::Zero();
};

/// A ray of a scan: along unit `d_S` from the sensor, `since_ns` after the scan's t_ns.
struct Beam {
  Vec3 d_S = Vec3::UnitX();
  TimeNs since_ns = 0;
};

/// A simulated image.
struct SimulatedPicture {
  Image<float> grey;            ///< 0 to 1, sRGB-encoded
  Image<float> depth_m;         ///< along the optical axis; 0: no surface, as in the sky
  Image<std::uint8_t> surface;  ///< a Surface; kMachine moves with the camera's link
};

}  // namespace tera
