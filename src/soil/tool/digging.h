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

/// A shovel at work: cuts what it sweeps, carries it, spills and dumps it, and is resisted.
///
/// Frames  W; B frame of the shovel's link.
/// Model   Geometry: no soil stays above the lowest point of the shovel's cross-section in any
///         column. A bucket carries the soil that comes in through its mouth until it is heaped
///         full. The rest goes outside in the direction of motion, with the soil that a blade, a
///         bucket's back or its shell meets. Soil over a buried bucket passes over it and falls
///         behind. Soil put outside lies over the columns that move with it, and from there rolls
///         down to repose. A heap that the edge slides goes along as it lies; else a passive wedge
///         rises from the shovel's lowest point at 45 deg - phi/2 and fans out. Soil before a blade
///         rides up and over it above the slope at repose down from its top edge.
///         Carried soil above the heap at repose, under the present apparent gravity, leaves over
///         the lower lip at a finite rate. It falls as clods, over the cutting edge between the
///         teeth. A layer sticks to the shell, as thick as adhesion (or cohesion, if less) holds
///         against its weight, but no thicker than a clod. Dug soil is loose: soil that does not
///         touch steel falls.
///         Force: CuttingEdge, ShovelWalls, and the shell's underside, which rests on the ground.
///         The underside is elastic up to the bearing pressure, then it presses the ground aside;
///         Coulomb friction acts along it. Soil over the ground, up to the lowest of the surfaces
///         on the shovel's four sides, is the ground's surcharge. So is the soil in a full bucket
///         whose mouth looks down. The shell is a cell thick towards its back, so that no soil
///         slips through it between two columns. Where a thin shell's face has passed over a column
///         in a step, it has cut there.
/// Omits   layers inside the bucket, the time in which its load slides, sticky soil that is shaken
///         off.
/// Source  Rankine 1857 (passive wedge); Terzaghi 1943 (bearing).
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
  struct Swept {
    int i, j;
    ShovelShape::Crossing crossing;
  };
  static constexpr double kLeastSpeed_mps = 1e-4;  ///< no direction below it
  /// A level unit vector below a direction.
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
  /// Columns in a row that move together.
  struct Heap {
    Vec2 out, direction;  ///< the first, and where the others are, in columns
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
  /// Where a lip lets soil through, along B's y axis.
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
  std::vector<Bearing> bearing_, bearing_loose_;  ///< of each soil, under the shell
  double beside_m_ = 0;                           ///< lowest surface on the shovel's four sides
  double lowest_m_ = 0, highest_m_ = 0;           ///< z of the shovel's lowest and highest point
  double heaped_m3_ = 0;
  SpoilMix carried_;
  double spilling_m3_ = 0;             ///< of it that should have left, less than a clod
  std::size_t spilt_ = 0;              ///< times that soil left over the edge
  double fullest_m3_ = 0;              ///< most that it carried since it was last empty
  Vec3 surface_up_B_ = Vec3::UnitZ();  ///< normal of the plane about which the load's surface lies
  double lies_m3_ = 0;                 ///< of the load, that lay so in the last step
  Vec3 up_W_mps2_ = kStandardGravity_mps2 * Vec3::UnitZ();  ///< against apparent gravity, smoothed
  std::size_t put_ = 0;                                     ///< parcels put outside so far
  std::vector<Swept> footprint_;
  enum Part : std::uint8_t { kOutside, kInShell, kInside };
  /// In which part of the shovel the columns of a rectangle stand.
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
  Mask mask_, mask_before_;        ///< in this step, in the last
  std::vector<ColumnId> blocked_;  ///< columns of the ground that this shovel blocks
};

}  // namespace tera
