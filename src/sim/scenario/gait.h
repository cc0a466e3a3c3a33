#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/motion.h"
#include "physics/description/machine.h"

namespace tera {

/// A limb that swings as its obstacle moves along its path.
struct ObstacleLimb {
  std::string name;
  Visual visual;                  ///< in the frame of the obstacle's mesh, at zero swing
  int of = -1;                    ///< index of its parent limb, a lower one; -1: the body
  Vec3 joint_B_m = Vec3::Zero();  ///< swing axis's position, with all limbs at zero swing
  std::vector<double> swing_rad;  ///< over a stride, forwards positive, relative to its parent
};

/// The gait of an obstacle.
///
/// Frames  B the obstacle's mesh, x forward, z up.
/// Model   swings and rise are given at equal parts of a stride of two steps, with linear
///         interpolation. The distance walked sets the phase, so that feet keep up with the ground.
///         Limbs swing about -y: a hanging limb swings forwards.
/// Omits   arms and legs that swing sideways, feet that follow uneven ground, turning.
struct Gait {
  double stride_m = 1;
  std::vector<double> rise_m;  ///< rise of the body above its place
  std::vector<ObstacleLimb> limbs;

  bool empty() const { return limbs.empty(); }
};

/// Reads `gait` of an obstacle whose own mesh is `body`; empty without such a key.
Gait ReadGait(const ConfigMap& config, const Visual& body);
/// Index of the limb that `limb` of `config` names; -1 without such a key.
int ReadLimbOf(const ConfigMap& config, const Gait& gait);

/// Rise of the body after `travel_m`, and the pose of each limb's frame in the body's. The meshes
/// have the scale `scale`.
double RiseOf(const Gait& gait, double scale, double travel_m);
std::vector<Pose> LimbPoses(const Gait& gait, double scale, double travel_m);

}  // namespace tera
