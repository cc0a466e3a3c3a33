#pragma once

#include <cstdint>

#include "core/motion.h"
#include "core/time.h"
#include "core/types/measurement.h"

namespace tera {

/// What a ray or a pixel meets in the simulation.
enum class Surface {
  kUnknown,  ///< not comparable: nothing tells where the sensor was, or what shape is met
  kNothing,
  kGround,
  kObstacle,
  kMachine
};

/// Whether a measurement of it can be compared.
inline bool IsComparable(Surface surface) {
  return surface == Surface::kGround || surface == Surface::kObstacle ||
         surface == Surface::kMachine;
}

/// What a ray meets in the simulation, and where.
///
/// Frames  W; B the sensor's link at the ray's own time.
struct SimulatedReturn {
  Surface surface = Surface::kUnknown;
  int object = 0;  ///< tells obstacles and parts of machines apart
  double range_m = 0;
  Vec3 normal_W = Vec3::Zero();  ///< unit, towards the sensor
  Pose X_WB = Pose::Identity();
  Vec3 v_WB_mps = Vec3::Zero(), w_WB_radps = Vec3::Zero();
};

/// A ray of a scan: along unit `d_S` from the sensor, `since_ns` after the scan's t_ns.
struct Beam {
  Vec3 d_S = Vec3::UnitX();
  TimeNs since_ns = 0;
};

/// A simulated picture, pixel by pixel.
struct SimulatedPicture {
  Image<float> grey;            ///< 0 to 1, as stored (sRGB)
  Image<float> depth_m;         ///< along the optical axis; 0: nothing, as in the sky
  Image<std::uint8_t> surface;  ///< a Surface: kMachine moves with the camera's link
};

}  // namespace tera
