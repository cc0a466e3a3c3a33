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

/// Resistance of the ground against a shovel's cutting edge and teeth.
///
/// Frames  W; B frame of the shovel's link.
/// Model   For each of several strips of the edge the least force along slip surfaces through the
///         ground as it lies ahead (CutAhead), with its own depth and speed, the carried soil's
///         surcharge, and its share of the flanks' shear; less where layers are weaker than their
///         mean, in the share that they are so on level ground (CutLayers). Edge and
///         teeth, which run ahead of it by their length, pierce the soil that they meet (Piercing).
///         Once the carried soil fills 0.8 of the struck capacity the soil separates along it
///         instead of the floor: the plane that cuts turns towards the mouth until the bucket is
///         full, soil rubs on soil, and what is carried weighs the less on the wedge. What comes in
///         pushes the carried soil up the floor, against its friction there and on the side walls
///         (at-rest pressure). All builds up over a few millimetres of travel (soil is elastic
///         before it fails), so that it holds at rest; no strip is ever driven on.
/// Omits   side cutters, slopes across the travel.
/// Source  see earthmoving.h; secondary separation as in Algoryx's terrain material.
class CuttingEdge {
 public:
  /// `soils` are those of the ground, as the machine meets them.
  CuttingEdge(const Shovel& shovel, const std::vector<SoilType>& soils);

  struct Carried {
    double mass_kg = 0, volume_m3 = 0;
    std::uint8_t soil = 0;
  };
  /// About the link's origin, over the next `dt_s`.
  Wrench Act(const ShovelShape& shape, const BodyState& body, const Carried& carried, double dt_s,
             const std::vector<SoilType>& soils, Columns* ground);
  /// How far ahead the last Act has moved the ground, mean of the strips; level, in W.
  const Vec2& lifted_W_m() const { return lifted_W_m_; }

 private:
  static constexpr int kStrips = 5;  ///< of the edge, each with its own depth and slope
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
