#pragma once

#include "core/types/ground_tools.h"
#include "soil/columns/columns.h"
#include "soil/track/low_obstacles.h"

namespace tera {

/// Contact of a point of the machine's structure with the ground.
///
/// Frames  W.
/// Model   A spring and damper act along the shortest path out of the ground (GroundExit), so that
///         the wall of a pit pushes a point sideways. A second spring acts perpendicular to this
///         path and yields at the limit of Coulomb friction. The ground only pushes. The first
///         spring is compressed by the motion of the point into the ground, at most to the length
///         of the path. So soil heaped over a point does not lift it. A spring becomes longer only
///         by motion against its force. So the ground returns at most the work that it received,
///         even if the direction of the path changes. If a low obstacle is deeper than the ground,
///         it bears the point instead. Loose soil yields at its bearing capacity under a square
///         footing. The footing is as wide as a 1:1 cone at the depth of the point. So a ridge is
///         ploughed, and a fill bears after some centimetres. Stiffness and damping scale with the
///         mass of the machine, and the contact width with its cube root. Similar machines then
///         sink in similarly.
/// Omits   Changes of the ground, weight of soil on the structure, strength limit of soil that is
///         not loose.
/// Source  Footing in loose soil: Terzaghi 1943, see BearingPressure_pa.
class HullContact {
 public:
  /// `mass_kg` is the mass of the whole machine. Obstacles that rise at most `climb_m` bear the
  /// point.
  HullContact(const GroundTools::HullPoint& point, double mass_kg, double climb_m = 0);
  int link() const { return point_.link; }
  Wrench Act(const BodyState& body, double dt_s, const Columns& ground,
             const LowObstacles& obstacles);

 private:
  void Release();
  double Most_n(const Vec3& p_W, double depth_m, const Columns& ground) const;

  GroundTools::HullPoint point_;
  double climb_m_, stiffness_npm_, damping_nspm_, corner_m_;
  double pressed_m_ = 0;             ///< compression of the spring along the way
  Vec3 sheared_W_m_ = Vec3::Zero();  ///< extension of the spring across the way
};

}  // namespace tera
