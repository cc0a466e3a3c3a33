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
/// Model   Each of several strips of the edge needs the least force along slip surfaces through the
///         ground ahead (CutAhead). A strip has its own depth and speed, the carried soil's
///         surcharge, and its share of the flanks' shear. Layers weaker than their mean reduce the
///         force by the same share as on level ground (CutLayers). Edge and teeth pierce the soil
///         that they meet (Piercing); the teeth run ahead of the edge by their length.
///         Once the carried soil fills 0.8 of the struck capacity, the soil separates along it
///         instead of the floor. The cutting plane then turns towards the mouth until the bucket is
///         full, soil rubs on soil, and the carried soil weighs less on the wedge. Incoming soil
///         pushes the carried soil up the floor, against friction there and on the side walls
///         (at-rest pressure). Forces build up over a few millimetres of travel (soil is elastic
///         before it fails), so that they hold at rest. They never drive a strip on.
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
