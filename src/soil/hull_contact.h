#pragma once

#include "core/ground_tools.h"
#include "soil/columns.h"

namespace tera {

/// Point of a machine's structure on the ground.
///
/// Model   A stiff spring and damper along the surface normal, Coulomb friction regularised below a
///         creep speed; the ground only pushes. The spring is as long as the point has come into
///         the ground by its own motion: soil that is heaped over a point lifts nothing.
/// Omits   any change of the ground, the weight of soil on the structure.
class HullContact {
 public:
  explicit HullContact(const GroundTools::HullPoint& point) : point_(point) {}
  int link() const { return point_.link; }
  Wrench Act(const BodyState& body, double dt_s, const Columns& ground);

 private:
  GroundTools::HullPoint point_;
  double pressed_m_ = 0;  ///< length of the spring
};

}  // namespace tera
