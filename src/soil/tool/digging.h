#pragma once

#include <vector>

#include "core/types/ground_tools.h"
#include "core/units.h"
#include "soil/columns/columns.h"
#include "soil/columns/spoil.h"
#include "soil/flow/grains.h"
#include "soil/tool/cutting_edge.h"
#include "soil/tool/shovel_shape.h"
#include "soil/tool/shovel_walls.h"

namespace tera {

/// A shovel that cuts, carries, spills and dumps soil, and the forces on it.
///
/// Frames  W; B frame of the shovel's link.
/// Model   Geometry: in each column, the shovel removes all soil above the lowest point of its
///         cross-section. A bucket carries the soil that enters through its mouth until it is
///         heaped full. Further soil goes outside, in the direction of motion. Soil in front of a
///         blade, of a bucket's back or of its shell goes outside too. Soil over a buried bucket
///         falls down behind it. Soil put outside is spread over the columns that move with the
///         shovel and rolls from there down to repose. A loose heap in front of the edge moves
///         along as a whole. Firm soil moves as a passive wedge that rises at 45 deg - phi/2 from
///         the lowest point and fans out. Soil in front of a blade flows over it once it reaches
///         the slope at repose from its top edge.
///         Load: carried soil above the heap at repose leaves over the lower lip at a finite rate.
///         Repose refers to apparent gravity. The soil falls as clods; at the cutting edge it falls
///         between the teeth. A layer sticks to the shell. Its thickness balances weight and
///         adhesion (or cohesion, if less), and is at most one clod. Dug soil is loose: soil that
///         does not touch steel falls.
///         Forces: CuttingEdge, ShovelWalls, and the underside of the shell on the ground. The
///         underside is elastic up to the bearing pressure; then it displaces the ground. Coulomb
///         friction acts along it. Soil above the ground, up to the lowest surface on the four
///         sides, adds surcharge. Soil in a full bucket with its mouth down adds surcharge too. The
///         shell counts as one cell thick towards its back, so that no soil slips between two
///         columns. A column is also cut where the edge passed over it within the step.
/// Omits   Layers inside the bucket, sliding time of the load, sticky soil that is shaken off.
/// Source  Rankine 1857 (passive wedge); Terzaghi 1943 (bearing).
class Digging {
 public:
  /// `soils` are the soils of the ground, scaled by the footing of the machine.
  Digging(const Shovel& shovel, std::vector<SoilType> soils);

  struct Result {
    Wrench wrench;  ///< about the link's origin, without the weight of the carried soil
    SoilReaction::Load load;
  };
  Result Act(const BodyState& body, double dt_s, Columns* ground, Grains* grains);
  int link() const { return shovel_.link; }
  const SpoilMix& carried() const { return carried_; }

 private:
  struct Swept {
    int i, j;
    ShovelShape::Crossing crossing;
  };
  static constexpr double kLeastSpeed_mps = 1e-4;  ///< least speed that has a direction
  /// Horizontal unit vector of a direction; +x if it is vertical.
  static Vec2 Level(const Vec3& v_W);
  Vec2 ShellThickness_B(const BodyState& body, double cell_m) const;
  void FrameMask(const BodyState& body, double behind_m, const Columns& ground);
  std::optional<ShovelShape::Crossing> CrossingOfShell(const ShovelShape::Upright& line,
                                                       const Vec2& behind_B) const;
  void FindFootprint(const BodyState& body, double dt_s, Columns* ground);
  void CutFootprint(const BodyState& body, double dt_s, Columns* ground, Wrench* wrench);
  bool PressShell(const BodyState& body, const Swept& swept, double dt_s, bool may_enter,
                  Columns* ground, double* keep_m, Wrench* wrench) const;
  double LowestBeside_m(const BodyState& body, const Columns& ground) const;
  using Place = Columns::Place;
  Vec2 WayOutFrom(const Swept& swept, const Vec2& direction) const;
  static Place PlaceNear(const Vec2& columns) {
    return {static_cast<int>(std::lround(columns.x())), static_cast<int>(std::lround(columns.y()))};
  }
  /// A row of columns that move together.
  struct Heap {
    Vec2 out, direction;  ///< first column, and step to the next, in columns
    std::size_t columns = 1;

    Place At(std::size_t n) const { return PlaceNear(out + static_cast<double>(n) * direction); }
  };
  double SlidesAsHeap(const Place& at, const Swept& swept, const Columns& ground) const;
  Heap HeapBefore(const BodyState& body, const Swept& swept, const Vec2& way_out,
                  const SoilType& soil, const Columns& ground) const;
  void PutOutside(const BodyState& body, const Swept& swept, const Vec2& way_out, SpoilMix* spoil,
                  Columns* ground);
  void LetPassOver(const Swept& swept, const Vec3& v_W, Columns* ground);
  bool RidesOver(const BodyState& body, const Place& at, double repose_rad,
                 const Columns& ground) const;
  bool RollsOn(double repose_rad, const Columns& ground, Place* at) const;
  static bool MovesAlong(const Vec3& v_W);
  Vec2 WayOut(const BodyState& body, const Vec3& p_W, const Vec3& v_W) const;
  bool IsShut(const BodyState& body, const Columns& ground) const;
  ShovelShape::Hold HoldOf(const Vec3& up_B) const;
  double Holds_m3(double heap_m3) const;
  void Spill(const BodyState& body, const Vec3& up_B, double heap_m3, double dt_s, Columns* ground,
             Grains* grains);
  /// Interval along B's y axis where a lip lets soil through.
  struct Gap {
    double from_m, to_m;
  };
  Gap NextGap(bool over_the_edge);
  void Settle(const Vec3& up_B);
  void FilterApparentGravity(const BodyState& body, double dt_s);
  bool InFootprint(int i, int j) const { return mask_.At(i, j) != kOutside; }

  Shovel shovel_;
  ShovelShape shape_;
  CuttingEdge edge_;
  ShovelWalls walls_;
  std::vector<SoilType> soils_;
  struct Bearing {
    double at_surface_pa, per_depth_papm;
    double At_pa(double depth_m) const { return at_surface_pa + per_depth_papm * depth_m; }
  };
  Bearing BearingOf(const SoilType& soil) const;
  /// for each soil: bearing pressure under the shell
  std::vector<Bearing> bearing_, bearing_loose_;
  double beside_m_ = 0;                  ///< lowest surface on the four sides of the shovel
  double lowest_m_ = 0, highest_m_ = 0;  ///< z of the lowest and highest point of the shovel
  double heaped_m3_ = 0;
  SpoilMix carried_;
  double spilling_m3_ = 0;             ///< excess soil that has not left yet, less than a clod
  std::size_t spilt_ = 0;              ///< number of spills over the edge
  double fullest_m3_ = 0;              ///< greatest load since the shovel was empty
  Vec3 surface_up_B_ = Vec3::UnitZ();  ///< normal of the plane of the load's surface
  double lies_m3_ = 0;                 ///< load in the last step
  Vec3 up_W_mps2_ = kStandardGravity_mps2 * Vec3::UnitZ();  ///< against apparent gravity, smoothed
  std::size_t put_ = 0;  ///< number of parcels put outside so far
  std::vector<Swept> footprint_;
  enum Part : std::uint8_t { kOutside, kInShell, kInside };
  /// Part of the shovel in which each column of a rectangle stands.
  struct Mask {
    int i0 = 0, i1 = -1, j0 = 0, j1 = -1;
    std::vector<Part> part;

    Part At(int i, int j) const {
      return i < i0 || i > i1 || j < j0 || j > j1 ? kOutside : part[Index(i, j)];
    }
    std::size_t Index(int i, int j) const {
      return static_cast<std::size_t>(j - j0) * (i1 - i0 + 1) + (i - i0);
    }
  };
  Mask mask_, mask_before_;        ///< of this step, of the last step
  std::vector<ColumnId> blocked_;  ///< columns that this shovel blocks
};

}  // namespace tera
