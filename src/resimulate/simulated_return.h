#pragma once

#include "core/motion.h"
#include "core/time.h"

namespace tera {

/// To what a ray or a pixel belongs, for a comparison.
enum class Surface {
  kUnknown,  ///< not to be compared: nothing tells where the sensor was, or what is hit
  kNothing,
  kGround,
  kObstacle,
  kMachine
};

/// What a ray meets in the simulation.
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

}  // namespace tera
