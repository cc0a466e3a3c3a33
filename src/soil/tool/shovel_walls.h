#pragma once

#include <vector>

#include "core/types/ground_tools.h"
#include "soil/columns/columns.h"
#include "soil/tool/piercing.h"
#include "soil/tool/shovel_shape.h"

namespace tera {

/// Resistance of the ground against a shovel's side walls, its back and the rim of its mouth, where
/// they are pushed into soil.
///
/// Frames  W; B frame of the shovel's link.
/// Model   The side walls, and the part of the back that is too steep to rest on the ground, push
///         soil before them as plates do. Each upright strip meets the passive pressure of the
///         ground beside it (CutAhead) between its lowest and its highest point. Along the mouth's
///         normal a bucket's rim (the side walls' edges and the top edge) is pushed in like a
///         cutting edge of the same thickness (Piercing). Forces build up over a few millimetres of
///         travel and hold at rest. They fade as a wall moves on along unpressed soil, and drive no
///         strip on.
/// Omits   friction along the walls, side cutters.
/// Source  see slip_ahead.h.
class ShovelWalls {
 public:
  /// `soils` are those of the ground, as the machine meets them.
  ShovelWalls(const Shovel& shovel, const std::vector<SoilType>& soils);

  /// About the link's origin, over the next `dt_s`.
  Wrench Act(const ShovelShape& shape, const BodyState& body, double dt_s,
             const std::vector<SoilType>& soils, Columns* ground);
  /// The shovel is out of the ground.
  void Release() { left_m_ = right_m_ = back_m_ = rim_m_ = 0; }

 private:
  /// Upright part of a wall.
  struct Strip {
    Vec3 low_B, high_B;
    double width_m;
  };
  std::vector<Strip> SideStrips(const ShovelShape& shape, const Vec3& up_B, double y_B) const;
  std::vector<Strip> BackStrips(const ShovelShape& shape, const Vec3& up_B) const;
  /// `travel_m` is how far the wall has gone into soil elastically.
  void Push(const std::vector<Strip>& strips, const Vec3& normal_B, const BodyState& body,
            double dt_s, const std::vector<SoilType>& soils, double* travel_m, Columns* ground,
            Wrench* wrench) const;
  void PierceWithRim(const ShovelShape& shape, const BodyState& body, double dt_s,
                     const std::vector<SoilType>& soils, Columns* ground, Wrench* wrench);

  Shovel shovel_;
  Piercing piercing_;
  double left_m_ = 0, right_m_ = 0, back_m_ = 0, rim_m_ = 0;  ///< elastic travel
};

}  // namespace tera
