#include "sim/operators/trench_work.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kStep_m = 0.05;  // spacing of samples along the trench
constexpr int kAcross = 7;        // samples over the bucket's width
// Largest step from stand to stand, as a share of the range of radii.
constexpr double kShareOfWindow = 0.75;
constexpr double kReachedStand_m = 0.1;
// Margin at both ends, because pulls may move the machine this far from its stand.
constexpr double kSpare_m = 0.15;
// Width of the ground beside the trench that the bucket may pass over.
constexpr double kBeside_m = 0.3;
constexpr double kLeastCut_m = 0.5;
// A pull ends where its path would rise by this, which would tip the machine.
constexpr double kClimb_m = 0.25;
constexpr double kLeftShare = 0.6;  // share of the tolerance; less soil above the design may remain
// Cuts with at least this share of the most soil count as equal; the farthest is chosen.
constexpr double kEqualShare = 0.9;
constexpr double kPitchStep_rad = 2 * kDeg, kMostTurn_rad = 70 * kDeg;
// Pitch of the tip that the bucket must reach at the smallest and the largest radius. From these
// pitches it can still curl enough to hold its load.
constexpr double kNearPitch_rad = -110 * kDeg, kFarPitch_rad = -105 * kDeg;
constexpr double kRadiusStep_m = 0.05, kMostRadius_m = 20;

bool IsWithin(const MachineModel& model, int joint, double q_rad) {
  return q_rad >= model.joints[joint].lower_rad && q_rad <= model.joints[joint].upper_rad;
}

bool Reaches(const MachineModel& model, const PlanarArm& arm, const PlanarArm::Joints& joints,
             const PlanarArm::Tip& tip) {
  const std::optional<PlanarArm::Angles> angles = arm.Inverse(tip);
  return angles && IsWithin(model, joints.boom, angles->boom_rad) &&
         IsWithin(model, joints.arm, angles->arm_rad) &&
         IsWithin(model, joints.bucket, angles->bucket_rad);
}

/// A pull over samples of the profile: the end index (exclusive) and the soil taken.
struct Pull {
  std::size_t end = 0;
  double soil_m3 = 0;
};

/// A pull from sample `start` until the bucket is full or the path would rise too much. `above_m`
/// is the height of the ground above the design, from the largest radius inwards.
Pull PullFrom(std::size_t start, const std::vector<double>& above_m, double layer_m,
              double bucket_m, double load_m3) {
  Pull pull{.end = start};
  double lowest_m = above_m[start];
  for (; pull.end < above_m.size() && pull.soil_m3 < load_m3; ++pull.end) {
    const double path_m = std::max(above_m[pull.end] - layer_m, 0.0);
    lowest_m = std::min(lowest_m, path_m);
    if (path_m > lowest_m + kClimb_m) break;
    pull.soil_m3 += std::clamp(above_m[pull.end], 0.0, layer_m) * bucket_m * kStep_m;
  }
  return pull;
}

}  // namespace

std::optional<PlanarArm::Tip> WithinLimits(const MachineModel& model, const PlanarArm& arm,
                                           const PlanarArm::Joints& joints,
                                           const PlanarArm::Tip& tip) {
  for (double turn_rad = 0; turn_rad <= kMostTurn_rad; turn_rad += kPitchStep_rad) {
    for (const double pitch_rad : {tip.pitch_rad + turn_rad, tip.pitch_rad - turn_rad}) {
      const PlanarArm::Tip turned{tip.r_m, tip.z_m, pitch_rad};
      if (Reaches(model, arm, joints, turned)) return turned;
    }
  }
  return std::nullopt;
}

std::optional<WorkingRadii> RadiiOfWork(const MachineModel& model, const PlanarArm& arm,
                                        const PlanarArm::Joints& joints, double top_m,
                                        double bottom_m) {
  const auto reaches = [&](double r_m, double pitch_rad) {
    return Reaches(model, arm, joints, {r_m, top_m, pitch_rad}) &&
           Reaches(model, arm, joints, {r_m, bottom_m, pitch_rad});
  };
  std::optional<WorkingRadii> radii;
  for (double r_m = kRadiusStep_m; r_m < kMostRadius_m; r_m += kRadiusStep_m) {
    if (!radii && reaches(r_m, kNearPitch_rad)) radii = WorkingRadii{r_m, r_m};
    if (radii && reaches(r_m, kFarPitch_rad)) radii->far_m = r_m;
  }
  return radii;
}

TrenchWork::TrenchWork(TrenchPlan plan) : plan_(std::move(plan)) {
  const double spare_m = std::max(0.0, line().width_m - plan_.bucket_m);
  const int gaps = static_cast<int>(std::ceil(spare_m / plan_.bucket_m));
  for (int k = 0; k <= gaps; ++k) {
    offsets_m_.push_back(gaps == 0 ? 0.0 : spare_m * (static_cast<double>(k) / gaps - 0.5));
  }
}

double TrenchWork::StationOf(const Vec2& xy_W_m) const {
  return (xy_W_m - line().from_W_m).dot(line().Along());
}

double TrenchWork::OffsetOf(const Vec2& xy_W_m) const {
  const Vec2 along = line().Along();
  return (xy_W_m - line().from_W_m).dot(Vec2(-along.y(), along.x()));
}

Vec2 TrenchWork::PlaceAt(double station_m, double offset_m) const {
  const Vec2 along = line().Along();
  return line().from_W_m + station_m * along + offset_m * Vec2(-along.y(), along.x());
}

double TrenchWork::DesignAt(double station_m, double offset_m) const {
  return plan_.task.design.FloorAt(PlaceAt(station_m, offset_m));
}

double TrenchWork::GroundAt(const TerrainSurface& ground, double station_m, double offset_m) const {
  // The outermost samples lie half a cell inside the bucket's width, like the columns of the floor.
  const double width_m = plan_.bucket_m - ground.cell_m;
  double sum_m = 0;
  for (int k = 0; k < kAcross; ++k) {
    const double across_m = width_m * (static_cast<double>(k) / (kAcross - 1) - 0.5);
    const Vec2 xy_m = PlaceAt(station_m, offset_m + across_m);
    sum_m += ground.HeightAt(xy_m.x(), xy_m.y());
  }
  return sum_m / kAcross;
}

double TrenchWork::Rim_m(const TerrainSurface& ground, double axis_station_m) const {
  double rim_m = -std::numeric_limits<double>::infinity();
  const double half_m = 0.5 * line().width_m + kBeside_m;
  for (double r_m = plan_.near_m; r_m <= plan_.far_m; r_m += kStep_m) {
    for (const double offset_m : {-half_m, 0.0, half_m}) {
      const Vec2 xy_m = PlaceAt(axis_station_m - r_m, offset_m);
      rim_m = std::max(rim_m, ground.HeightAt(xy_m.x(), xy_m.y()));
    }
  }
  return rim_m;
}

std::optional<TrenchCut> TrenchWork::NextCut(const TerrainSurface& ground, double axis_station_m,
                                             double layer_m, double load_m3) const {
  const double from_m = std::max(plan_.near_m, axis_station_m - line().length_m());
  const double to_m = std::min(plan_.far_m, axis_station_m);
  const double left_m = kLeftShare * plan_.task.tolerance_m;
  std::optional<TrenchCut> best;
  double best_m3 = 0;
  for (const double offset_m : offsets_m_) {
    std::vector<double> above_m;  // input of PullFrom
    for (double r_m = to_m; r_m >= from_m - 1e-9; r_m -= kStep_m) {
      const double station_m = axis_station_m - r_m;
      above_m.push_back(GroundAt(ground, station_m, offset_m) - DesignAt(station_m, offset_m));
    }
    // No pull starts within kLeastCut_m of the smallest radius if there is a next stand. The soil
    // there is cut at the end of a longer pull, or from that stand.
    const auto least = static_cast<std::size_t>(kLeastCut_m / kStep_m);
    const std::size_t nearest = above_m.size() - std::min(above_m.size(), least);
    const std::size_t ends = NextStand(axis_station_m) ? nearest : above_m.size();
    for (std::size_t start = 0; start < ends; ++start) {
      if (above_m[start] < left_m) continue;
      const auto [end, soil_m3] = PullFrom(start, above_m, layer_m, plan_.bucket_m, load_m3);
      if (soil_m3 * kEqualShare <= best_m3) continue;
      best_m3 = soil_m3;
      const std::size_t first = std::min(start, end - std::min(end, least));
      const double reach_m = to_m - static_cast<double>(first) * kStep_m;
      const double length_m = static_cast<double>(std::max(end, first + least) - first) * kStep_m;
      best = TrenchCut{reach_m, std::min(length_m, std::max(reach_m - from_m, kStep_m)), offset_m};
    }
  }
  return best;
}

double TrenchWork::first_stand_m() const { return plan_.far_m - kSpare_m; }

std::optional<double> TrenchWork::NextStand(double axis_station_m) const {
  const double first_m = first_stand_m();
  const double last_m = std::max(first_m, line().length_m() + plan_.near_m + kSpare_m);
  if (axis_station_m > last_m - kReachedStand_m) return std::nullopt;
  const double most_m = kShareOfWindow * (plan_.far_m - plan_.near_m);
  const double moves = std::ceil((last_m - first_m) / most_m);
  const double step_m = (last_m - first_m) / moves;
  const double done = std::floor((axis_station_m - first_m + kReachedStand_m) / step_m);
  return first_m + (std::max(done, 0.0) + 1) * step_m;
}

}  // namespace tera
