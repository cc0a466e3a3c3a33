#pragma once

#include "core/ground_tools.h"
#include "soil/columns.h"

namespace tera {

/// Point of a machine's structure on the ground.
///
/// Model   A stiff spring and damper along the surface normal, Coulomb friction regularised below a
///         creep speed; the ground only pushes.
/// Omits   any change of the ground.
class HullContact {
 public:
  explicit HullContact(const GroundTools::HullPoint& point) : point_(point) {}
  int link() const { return point_.link; }
  Wrench Act(const BodyState& body, const Columns& ground) const;

 private:
  GroundTools::HullPoint point_;
};

}  // namespace tera
