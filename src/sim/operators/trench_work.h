#pragma once

#include <optional>
#include <vector>

#include "core/types/terrain_surface.h"
#include "sim/operators/planar_arm.h"
#include "sim/operators/skid_steer.h"
#include "sim/task/task.h"

namespace tera {

/// A trench, and where a machine reaches its floor.
struct TrenchPlan {
  Task task;  ///< with a trench
  SkidSteerLevers tracks;
  double bucket_m = 0;           ///< width of the bucket
  double near_m = 0, far_m = 0;  ///< radii from the slew axis between which it digs
};

/// One pull of the bucket.
struct TrenchCut {
  double reach_m = 0, length_m = 0;  ///< radius at which the teeth enter; from there inwards
  double offset_m = 0;               ///< of the pull from the trench's line, to the left
};

/// Where to stand and what to cut next, so that a ground comes to its design.
///
/// Frames  stations are along the trench's line from its first end. The machine stands on the line
///         and faces that end, so that radius r is at its own station minus r.
/// Model   The machine backs away. At the first stand its farthest radius is a little beyond the
///         first end, at the last its nearest radius is as much beyond the other end. Stands
///         between are at equal distances, of at most kShareOfWindow of the radii. The next cut is
///         the one of most soil above the design, no deeper than one layer, in a length that fills
///         the bucket. Soil at the nearest radii is left to the next stand, if there is one. A
///         trench wider than the bucket is cut in strips side by side.
class TrenchWork {
 public:
  explicit TrenchWork(TrenchPlan plan);

  double StationOf(const Vec2& xy_W_m) const;
  double OffsetOf(const Vec2& xy_W_m) const;  ///< positive to the left, seen along the line
  Vec2 PlaceAt(double station_m, double offset_m) const;
  double DesignAt(double station_m, double offset_m) const;
  /// Mean height of the ground across the bucket.
  double GroundAt(const TerrainSurface& ground, double station_m, double offset_m) const;
  /// Highest ground on and beside the part of the trench in reach.
  double Rim_m(const TerrainSurface& ground, double axis_station_m) const;

  /// Nothing if the ground in reach is as designed.
  std::optional<TrenchCut> NextCut(const TerrainSurface& ground, double axis_station_m,
                                   double layer_m, double load_m3) const;
  double first_stand_m() const;
  /// The stand after one at `axis_station_m`; nothing after the last.
  std::optional<double> NextStand(double axis_station_m) const;
  const TrenchPlan& plan() const { return plan_; }
  const TrenchLine& line() const { return *plan_.task.trench; }

 private:
  TrenchPlan plan_;
  std::vector<double> offsets_m_;  ///< of the strips
};

/// Radii between which the tip reaches both `top_m` and `bottom_m`, heights relative to the slewing
/// frame, with the bucket at a digging pitch; nothing if there are none.
struct WorkingRadii {
  double near_m, far_m;
};
std::optional<WorkingRadii> RadiiOfWork(const MachineModel& model, const PlanarArm& arm,
                                        const PlanarArm::Joints& joints, double top_m,
                                        double bottom_m);

/// `tip` with the pitch nearest to its own at which the joints reach it within their limits;
/// nothing if there is none.
std::optional<PlanarArm::Tip> WithinLimits(const MachineModel& model, const PlanarArm& arm,
                                           const PlanarArm::Joints& joints,
                                           const PlanarArm::Tip& tip);

}  // namespace tera
