#pragma once

#include <vector>

#include "core/types/ground_tools.h"
#include "soil/columns/columns.h"
#include "soil/tool/piercing.h"
#include "soil/tool/shovel_shape.h"

namespace tera {

/// Resistance of the ground to the side walls, the back and the rim of a shovel's mouth.
///
/// Frames  W; B frame of the shovel's link.
/// Model   The side walls push soil like plates. So does the part of the back that is too steep to
///         rest on the ground. Each vertical strip meets the passive pressure of the ground in
///         front of it (CutAhead) between its lowest and highest point. The rim of a bucket
///         consists of the side walls' edges and the top edge. Along the mouth's normal it pierces
///         soil like a cutting edge of the same thickness (Piercing). Forces build up over a few
///         millimetres of elastic travel and persist at rest. They fade as a wall slides along to
///         fresh soil, and never accelerate a strip along its motion.
/// Omits   Friction along the walls, side cutters.
/// Source  slip_ahead.h.
class ShovelWalls {
 public:
  /// `soils` are the soils of the ground, scaled by the footing of the machine.
  ShovelWalls(const Shovel& shovel, const std::vector<SoilType>& soils);

  /// Advances by `dt_s` and returns the wrench about the link's origin.
  Wrench Act(const ShovelShape& shape, const BodyState& body, double dt_s,
             const std::vector<SoilType>& soils, Columns* ground);
  /// Resets the elastic travel of a shovel out of the ground.
  void Release() { left_m_ = right_m_ = back_m_ = rim_m_ = 0; }

 private:
  /// Vertical strip of a wall.
  struct Strip {
    Vec3 low_B, high_B;
    double width_m;
  };
  std::vector<Strip> SideStrips(const ShovelShape& shape, const Vec3& up_B, double y_B) const;
  std::vector<Strip> BackStrips(const ShovelShape& shape, const Vec3& up_B) const;
  /// `travel_m` is the elastic travel of the wall into the soil.
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
