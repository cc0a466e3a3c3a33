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
  Visual visual;                  ///< in the frame of the obstacle's mesh, hanging as at no swing
  int of = -1;                    ///< the limb that it hangs on, one before it; -1: the body
  Vec3 joint_B_m = Vec3::Zero();  ///< about which it swings, as at no swing of any limb
  std::vector<double> swing_rad;  ///< over a stride, forwards positive, against that it hangs on
};

/// How an obstacle walks.
///
/// Frames  B the obstacle's mesh, x forward, z up.
/// Model   swings and rise are given at equal parts of a stride, of two steps, and straight between
///         them; what has been walked is where in it the obstacle is, so that feet keep up with the
///         ground. Limbs swing about -y, so that one that hangs swings forwards.
/// Omits   arms and legs that swing sideways, feet that follow uneven ground, turning.
struct Gait {
  double stride_m = 1;
  std::vector<double> rise_m;  ///< of the body above its place
  std::vector<ObstacleLimb> limbs;

  bool empty() const { return limbs.empty(); }
};

/// Reads `gait` of an obstacle whose own mesh is `body`; none where there is no such key.
Gait ReadGait(const ConfigMap& config, const Visual& body);
/// The limb that `limb` of `config` names; -1 where there is no such key.
int ReadLimbOf(const ConfigMap& config, const Gait& gait);

/// How much the body rises after `travel_m`, and where each limb's frame is then in the body's:
/// their meshes are of `scale`.
double RiseOf(const Gait& gait, double scale, double travel_m);
std::vector<Pose> LimbPoses(const Gait& gait, double scale, double travel_m);

}  // namespace tera
