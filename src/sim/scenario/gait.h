#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/motion.h"
#include "physics/description/machine.h"

namespace tera {

/// A limb of a walking obstacle. It swings as the obstacle moves along its path.
struct ObstacleLimb {
  std::string name;
  Visual visual;  ///< in the frame of the obstacle's mesh, with all limbs at zero swing
  int of = -1;    ///< index of the parent limb, which comes earlier; -1: the body
  Vec3 joint_B_m = Vec3::Zero();  ///< position of the swing axis, with all limbs at zero swing
  /// Samples over a stride; relative to the parent, forwards positive.
  std::vector<double> swing_rad;
};

/// The gait of a walking obstacle.
///
/// Frames  B is the obstacle's mesh, x forward, z up.
/// Model   a stride is two steps. Swings and rise are samples at equal parts of it, interpolated
///         linearly. The walked distance sets the phase, so that feet do not slide. Positive swing
///         rotates about -y: a hanging limb moves forwards.
/// Omits   sideways swings, feet that follow uneven ground, turning.
struct Gait {
  double stride_m = 1;
  /// Rise of the body above its standing height; samples over a stride.
  std::vector<double> rise_m;
  std::vector<ObstacleLimb> limbs;

  bool empty() const { return limbs.empty(); }
};

/// Reads the key `gait` of an obstacle whose own mesh is `body`. Empty without that key.
Gait ReadGait(const ConfigMap& config, const Visual& body);
/// Index of the limb that the key `limb` names; -1 without that key.
int ReadLimbOf(const ConfigMap& config, const Gait& gait);

/// Rise of the body after `travel_m`, and the pose of each limb relative to the body. `scale` is
/// the scale of the meshes.
double RiseOf(const Gait& gait, double scale, double travel_m);
std::vector<Pose> LimbPoses(const Gait& gait, double scale, double travel_m);

}  // namespace tera
