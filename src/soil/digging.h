#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/ground_tools.h"
#include "soil/columns.h"
#include "soil/grains.h"
#include "soil/shovel_shape.h"
#include "soil/spoil.h"

namespace tera {

/// A shovel at work: cuts what it sweeps, carries it, spills and dumps it, and is resisted.
///
/// Frames  W; B frame of the shovel's link.
/// Model   Geometry: no soil stays above the lowest point of the shovel's cross-section in any
///         column. What comes in through the mouth is carried (a bucket) or put just ahead (a
///         blade, or a bucket moved back first); what the shell presses away is put beside.
///         Carried soil beyond what stands heaped at the angle of repose in the present attitude
///         leaves over the lower lip at a finite rate, as clods that fall.
///         Force: the fundamental earthmoving equation for each of several strips of the edge with
///         its own depth, ground slope and the carried soil's surcharge, flank shear once, and the
///         penetration resistance of the teeth and, a tooth's length behind their tips, of the
///         edge. It builds up over a few millimetres of travel (soil is elastic before it fails),
///         which makes it hold at rest and opposes motion. The shell's underside rests on the
///         ground: elastic up to the bearing pressure, then it presses the ground aside; Coulomb
///         friction along it.
/// Omits   resistance against the side walls, secondary separation.
/// Source  see earthmoving.h; teeth as in Algoryx's terrain material (10 % at the surface, 100 % at
///         0.5 m).
class Digging {
 public:
  /// `soils` are those of the ground, as the machine meets them.
  Digging(const Shovel& shovel, std::vector<SoilType> soils);

  struct Result {
    Wrench wrench;  ///< about the link's origin, without the weight of the carried soil
    SoilReaction::Load load;
  };
  Result Act(const BodyState& body, double dt_s, Columns* ground, Grains* grains);
  int link() const { return shovel_.link; }
  const SpoilMix& carried() const { return carried_; }

 private:
  static constexpr int kStrips = 5;  ///< of the edge, each with its own depth and slope
  struct Strip;
  struct Swept {
    int i, j;
    ShovelShape::Crossing crossing;
  };
  void FindFootprint(const BodyState& body, Columns* ground);
  void CutFootprint(const BodyState& body, double dt_s, Columns* ground, Wrench* wrench);
  void PutOutside(int i, int j, const Vec2& direction, const SpoilMix& spoil,
                  Columns* ground) const;
  void Spill(const BodyState& body, double dt_s, Columns* ground, Grains* grains);
  Wrench EdgeForce(const BodyState& body, double dt_s, const Columns& ground);
  std::optional<Vec3> CutDirection(const Mat3& R_WB) const;
  std::array<Strip, kStrips> Strips(const BodyState& body, const Vec3& travel_W,
                                    const Columns& ground) const;
  Vec3 CuttingForceOn(const Strip& strip, const Vec3& travel_W, const Vec3& floor_W,
                      double speed_mps) const;
  double PiercingForceOn_n(const Strip& strip, double sine_down) const;
  bool InFootprint(int i, int j) const;

  Shovel shovel_;
  ShovelShape shape_;
  std::vector<SoilType> soils_;
  SpoilMix carried_;
  double spilling_m3_ = 0;      ///< of it that should have left, less than a clod
  double cut_travel_m_ = 0;     ///< elastic travel of the edge in its cutting direction
  double pierce_travel_m_ = 0;  ///< elastic travel of edge and teeth along the floor
  std::vector<Swept> footprint_;
  int i0_ = 0, i1_ = -1, j0_ = 0, j1_ = -1;
  std::vector<std::uint8_t> mask_;
  std::vector<ColumnId> blocked_;  ///< columns of the ground that this shovel blocks
};

}  // namespace tera
