#pragma once

#include <optional>
#include <vector>

#include "core/types/terrain_surface.h"
#include "sim/operators/planar_arm.h"
#include "sim/operators/skid_steer.h"
#include "sim/task/task.h"

namespace tera {

/// A trench, and the reach of a machine at its floor.
struct TrenchPlan {
  Task task;  ///< its trench is set
  SkidSteerLevers tracks;
  double bucket_m = 0;
  double near_m = 0, far_m = 0;  ///< smallest and largest digging radius from the slew axis
};

/// One pull of the bucket towards the machine.
struct TrenchCut {
  /// Radius at which the teeth enter, and length of the pull inwards.
  double reach_m = 0, length_m = 0;
  double offset_m = 0;  ///< lateral offset of the pull from the trench's line, to the left
};

/// Chooses where the machine stands and what it cuts next, until the ground matches its design.
///
/// Frames  a station is a distance along the trench's line from its first end. The machine stands
///         on the line and faces the first end. A point at radius r from the slew axis thus has the
///         axis's station minus r.
/// Model   the machine works from the first end to the other one, driving backwards. At the first
///         stand its largest radius lies slightly beyond the first end. At the last stand its
///         smallest radius lies as far beyond the other end. The stands between are equally spaced,
///         at most kShareOfWindow of the range of radii apart.
///         The next cut is the pull that takes the most soil above the design. A pull is at most
///         one layer deep and ends when the bucket is full. Soil that only a very short pull could
///         reach is left to the next stand, if there is one. A trench that is wider than the bucket
///         is cut in parallel strips.
class TrenchWork {
 public:
  explicit TrenchWork(TrenchPlan plan);

  double StationOf(const Vec2& xy_W_m) const;
  double OffsetOf(const Vec2& xy_W_m) const;  ///< positive to the left, looking along the line
  Vec2 PlaceAt(double station_m, double offset_m) const;
  double DesignAt(double station_m, double offset_m) const;
  /// Mean ground height over the bucket's width.
  double GroundAt(const TerrainSurface& ground, double station_m, double offset_m) const;
  /// Highest ground on or next to the part of the trench within reach.
  double Rim_m(const TerrainSurface& ground, double axis_station_m) const;

  /// The next cut from a stand with the slew axis at `axis_station_m`. `layer_m` is the depth of a
  /// layer, `load_m3` the soil that fills the bucket. Empty if the ground within reach is finished.
  std::optional<TrenchCut> NextCut(const TerrainSurface& ground, double axis_station_m,
                                   double layer_m, double load_m3) const;
  double first_stand_m() const;
  /// The stand after the one at `axis_station_m`. Empty after the last.
  std::optional<double> NextStand(double axis_station_m) const;
  const TrenchPlan& plan() const { return plan_; }
  const TrenchLine& line() const { return *plan_.task.trench; }

 private:
  TrenchPlan plan_;
  std::vector<double> offsets_m_;  ///< lateral offsets of the strips
};

/// Range of radii at which the tip, at a pitch for digging, reaches both heights. Heights are
/// relative to the slewing frame. Empty if no radius is suitable.
struct WorkingRadii {
  double near_m, far_m;
};
std::optional<WorkingRadii> RadiiOfWork(const MachineModel& model, const PlanarArm& arm,
                                        const PlanarArm::Joints& joints, double top_m,
                                        double bottom_m);

/// `tip` with the pitch changed as little as possible, so that the joints reach it within their
/// limits. Empty if no pitch is possible.
std::optional<PlanarArm::Tip> WithinLimits(const MachineModel& model, const PlanarArm& arm,
                                           const PlanarArm::Joints& joints,
                                           const PlanarArm::Tip& tip);

}  // namespace tera
