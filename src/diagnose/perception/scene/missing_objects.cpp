#include "diagnose/perception/scene/missing_objects.h"

#include <cmath>
#include <map>

#include "diagnose/perception/scene/moderated_t_test.h"

namespace tera {
namespace {

/// Least distances of a point behind or in front of a surface, along the ray and along the normal.
constexpr double kLeastAlongRay_m = 0.3, kLeastAlongNormal_m = 0.15;
constexpr double kAlpha = 0.01;  ///< level of both tests, over all objects
constexpr std::size_t kFewestRays = 20;
constexpr ModeratedTTest kMoreThanHalf{.limit = 0.5, .fewest_blocks = 3, .least_sigma = 0.03};

/// Rays that hit one object in the simulation, per block of time.
struct RayCount {
  double all = 0, through = 0;
};

struct Tally {
  std::map<std::size_t, RayCount> seen, held_out;            ///< counts of rays, by block of time
  std::vector<std::pair<std::size_t, std::size_t>> through;  ///< scan and point
  Vec2 where_W_m = Vec2::Zero();
  double square_m2 = 0, final_rays = 0;
  std::size_t rays = 0;
};

/// p-value of the test that more than half of the rays pass through the object.
double ShareP(const std::map<std::size_t, RayCount>& blocks) {
  std::vector<double> shares;
  for (const auto& [block, count] : blocks) shares.push_back(count.through / count.all);
  return kMoreThanHalf.P(shares);
}

void AddScan(const RangeSource& source, const ScanSplit& split,
             const SensorCalibration& calibration, std::size_t scan,
             std::map<int, Tally>* tallies) {
  const std::vector<RangePoint>& points = source.scans[scan].points;
  const std::vector<SimulatedReturn> hits =
      source.cast(scan, calibration, BeamsOf(source.scans[scan]));
  const bool is_final = split.part[scan] == Part::kFinal;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (hits[p].surface != Surface::kObstacle) continue;
    const double behind_m =
        TruePoint(source, calibration, points[p].p_S_m).norm() - hits[p].range_m;
    const double off_m = PointToPlane_m(source, calibration, points[p], hits[p]);
    const bool went_on = behind_m > kLeastAlongRay_m && off_m > kLeastAlongNormal_m;
    // Something else stopped a ray that ends in front of the object.
    if (behind_m < -kLeastAlongRay_m && off_m < -kLeastAlongNormal_m) continue;
    Tally& tally = (*tallies)[hits[p].object];
    RayCount& count = (is_final ? tally.held_out : tally.seen)[split.block[scan]];
    count.all += 1;
    ++tally.rays;
    if (is_final) {
      tally.final_rays += 1;
      tally.square_m2 += off_m * off_m;
    }
    if (!went_on) continue;
    count.through += 1;
    tally.through.emplace_back(scan, p);
    const Vec3 d_W = RayDirection_W(calibration, points[p], hits[p]);
    const Vec3 met_W_m = PointInWorld(source, calibration, points[p], hits[p]) - behind_m * d_W;
    tally.where_W_m += met_W_m.head<2>();
  }
}

}  // namespace

MissingObjects FindMissingObjects(const RangeSource& source, const ScanSplit& split,
                                  const SensorCalibration& calibration) {
  std::map<int, Tally> tallies;
  for (std::size_t s = 0; s < source.scans.size(); ++s) {
    AddScan(source, split, calibration, s, &tallies);
  }
  MissingObjects missing;
  missing.explained = NoPoints(source.scans);
  const auto objects = static_cast<double>(tallies.size());
  for (const auto& [object, tally] : tallies) {
    if (tally.rays < kFewestRays) continue;
    MissingObject one;
    one.object = object;
    one.rays = tally.rays;
    const auto through = static_cast<double>(tally.through.size());
    one.share = through / static_cast<double>(tally.rays);
    one.p_chosen = ShareP(tally.seen);
    one.p_confirmed = ShareP(tally.held_out);
    if (one.p_chosen > kAlpha / objects || one.p_confirmed > kAlpha / objects) continue;
    // Mean of the simulated hits.
    one.centre_W_m = one.low_W_m = one.high_W_m = tally.where_W_m / through;
    one.rmse_before_m = std::sqrt(tally.square_m2 / tally.final_rays);
    for (const auto& [scan, point] : tally.through) missing.explained[scan][point] = true;
    missing.objects.push_back(one);
  }
  return missing;
}

}  // namespace tera
