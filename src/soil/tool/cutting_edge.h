#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/types/ground_tools.h"
#include "soil/columns/columns.h"
#include "soil/tool/cut_soil.h"
#include "soil/tool/earthmoving.h"
#include "soil/tool/piercing.h"
#include "soil/tool/shovel_shape.h"

namespace tera {

/// Resistance of the ground to the cutting edge and the teeth of a shovel.
///
/// Frames  W; B frame of the shovel's link.
/// Model   The edge is divided into strips with their own depth and speed. The force on a strip is
///         the least over slip surfaces through the ground ahead (CutAhead). It includes the
///         surcharge of carried soil and a share of the shear on the flanks. Layers of unequal
///         strength reduce it by the same ratio as on level ground (CutLayers). Edge and teeth also
///         pierce the soil (Piercing); the teeth reach ahead by their length.
///         From 0.8 of the struck capacity on, soil separates along the carried soil instead of the
///         floor. Until the bucket is full, the cutting plane turns from the floor to the mouth.
///         Soil friction then replaces steel friction, and less of the carried weight rests on the
///         wedge. Incoming soil pushes the carried soil up the floor, against friction on the floor
///         and on the side walls (at-rest pressure). Forces build up over a few millimetres of
///         elastic travel, so that they persist at rest. They never accelerate a strip along its
///         motion.
/// Omits   Side cutters, slopes across the travel.
/// Source  earthmoving.h; secondary separation as in the terrain material of Algoryx.
class CuttingEdge {
 public:
  /// `soils` are the soils of the ground, scaled by the footing of the machine.
  CuttingEdge(const Shovel& shovel, const std::vector<SoilType>& soils);

  struct Carried {
    double mass_kg = 0, volume_m3 = 0;
    std::uint8_t soil = 0;
  };
  /// Advances by `dt_s` and returns the wrench about the link's origin.
  Wrench Act(const ShovelShape& shape, const BodyState& body, const Carried& carried, double dt_s,
             const std::vector<SoilType>& soils, Columns* ground);
  /// Horizontal length of ground that the last Act moved ahead of the edge, as a vector in W. Mean
  /// of the strips.
  const Vec2& lifted_W_m() const { return lifted_W_m_; }

 private:
  static constexpr int kStrips = 5;  ///< strips of the edge, each with its own depth and slope
  struct Strip;
  struct Plane;
  std::array<Strip, kStrips> Strips(const ShovelShape& shape, const BodyState& body,
                                    const Vec3& travel_W, const std::vector<SoilType>& soils,
                                    Columns* ground) const;
  Plane CutPlane(const ShovelShape& shape, const Mat3& R_WB, const Carried& carried) const;
  CuttingForce CutBy(const Strip& strip, const Vec3& travel_W, const Plane& plane,
                     double speed_mps) const;
  double DragInside_n(const ShovelShape& shape, const Mat3& R_WB, const Carried& carried,
                      const SoilType& soil) const;
  double PiercingForceOn_n(const Strip& strip, double sine_down) const;

  Shovel shovel_;
  Piercing piercing_;
  Vec2 lifted_W_m_ = Vec2::Zero();
  double cut_travel_m_ = 0;     ///< elastic travel of the edge in its cutting direction
  double pierce_travel_m_ = 0;  ///< elastic travel of edge and teeth along the floor
};

}  // namespace tera
