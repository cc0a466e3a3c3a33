#pragma once

#include "core/types/ground_tools.h"
#include "soil/columns/columns.h"
#include "soil/track/low_obstacles.h"

namespace tera {

/// Point of a machine's structure on the ground.
///
/// Frames  W.
/// Model   A spring and damper act along the shortest way out of the ground (GroundExit), so that a
///         pit's wall pushes sliding points sideways. Another spring acts across it and yields
///         where Coulomb friction is used up. The ground only pushes. The first spring is as long
///         as the point's own motion into the ground, and at most as the way out: soil heaped over
///         a point lifts nothing. Springs change by motion against their force, or they shorten. So
///         the ground never gives more work than it took, however the way out turns. The deeper one
///         of the ground and a low obstacle bears the point.
///         Loose soil gives way beyond its bearing capacity under a square footing as wide as the
///         contact of the point's cone of 1 to 1. So a ridge is ploughed, and a fill bears after
///         some centimetres. Stiffness and damping are in proportion to the machine's mass, the
///         contact's width to its cube root: alike machines go in alike.
/// Omits   any change of the ground, the weight of soil on the structure, the strength of ground
///         that is not loose.
/// Source  footing in loose soil: Terzaghi 1943, see BearingPressure_pa.
class HullContact {
 public:
  /// `mass_kg` is that of the whole machine; obstacles that rise no more than `climb_m` bear it.
  HullContact(const GroundTools::HullPoint& point, double mass_kg, double climb_m = 0);
  int link() const { return point_.link; }
  Wrench Act(const BodyState& body, double dt_s, const Columns& ground,
             const LowObstacles& obstacles);

 private:
  void Release();
  double Most_n(const Vec3& p_W, double depth_m, const Columns& ground) const;

  GroundTools::HullPoint point_;
  double climb_m_, stiffness_npm_, damping_nspm_, corner_m_;
  double pressed_m_ = 0;             ///< length of the spring along the way out
  Vec3 sheared_W_m_ = Vec3::Zero();  ///< of the spring across it
};

}  // namespace tera
