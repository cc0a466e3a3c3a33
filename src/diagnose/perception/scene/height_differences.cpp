#include "diagnose/perception/scene/height_differences.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace tera {
namespace {

/// An object hit by a test ray counts if its range differs from the measured range by less than
/// this.
constexpr double kSameRange_m = 0.3;
constexpr double kTurns_rad[] = {0.4 * kDeg, 1.2 * kDeg};
constexpr int kDirections = 8;

}  // namespace

std::vector<bool> OnOcclusionEdges(const RangeSource& source, const SensorCalibration& calibration,
                                   std::size_t scan, const std::vector<std::size_t>& points) {
  std::vector<Beam> beams;
  for (const std::size_t p : points) {
    const Beam straight = BeamOf(source.scans[scan].points[p]);
    const Vec3 aside = straight.d_S.unitOrthogonal(), other = straight.d_S.cross(aside);
    for (const double turn_rad : kTurns_rad) {
      for (int k = 0; k < kDirections; ++k) {
        const double angle_rad = 2 * kPi * k / kDirections;
        const Vec3 to = std::cos(angle_rad) * aside + std::sin(angle_rad) * other;
        beams.push_back({(straight.d_S + turn_rad * to).normalized(), straight.since_ns});
      }
    }
  }
  const std::vector<SimulatedReturn> hits = source.cast(scan, calibration, beams);
  const std::size_t each = points.empty() ? 1 : beams.size() / points.size();
  std::vector<bool> on_edge(points.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const bool object = hits[i].surface != Surface::kGround && hits[i].surface != Surface::kNothing;
    const double true_m =
        TruePoint(source, calibration, source.scans[scan].points[points[i / each]].p_S_m).norm();
    // An unknown surface may be a track, or soil in a bucket.
    if (object && (hits[i].range_m == 0 || std::abs(hits[i].range_m - true_m) < kSameRange_m)) {
      on_edge[i / each] = true;
    }
  }
  return on_edge;
}

namespace {

/// A point lies on an object within this distance of its surface, or within this number of standard
/// deviations.
constexpr double kOnObject_m = 0.15, kOnObjectSigmas = 6;
/// Points with a larger height difference are tested for edges and cliffs.
constexpr double kUnremarkable_m = 0.04;
constexpr double kCliffReach_m = 0.08;  ///< horizontal displacement of a point by pose errors
constexpr double kLeastCliff_m = 0.05, kHeightNoise_m = 0.01;
constexpr double kGreatestHeight_m = 10;  ///< larger height differences are ignored

/// True if a point lies on the simulated object that its ray hits.
bool LiesOnObject(const RangeSource& source, const SensorCalibration& calibration,
                  const RangePoint& point, const SimulatedReturn& hit, double scale) {
  if (hit.surface != Surface::kObstacle && hit.surface != Surface::kMachine) return false;
  const double near_m = std::max(kOnObject_m, kOnObjectSigmas * scale * point.sigma_m);
  return std::abs(PointToPlane_m(source, calibration, point, hit)) < near_m;
}

/// True if the simulated ground has a cliff at the point: within kCliffReach_m it varies by over 5
/// cm, across the point's height.
bool IsOnCliff(const RangeSource& source, std::size_t scan, const Vec3& p_W_m) {
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
  for (int a = -1; a <= 1; ++a) {
    for (int b = -1; b <= 1; ++b) {
      const auto h = source.ground_m(scan, p_W_m.head<2>() + kCliffReach_m * Vec2(a, b));
      if (!h) continue;
      low_m = std::min(low_m, *h);
      high_m = std::max(high_m, *h);
    }
  }
  return p_W_m.z() > low_m - kHeightNoise_m && p_W_m.z() < high_m + kHeightNoise_m &&
         high_m - low_m > kLeastCliff_m;
}

}  // namespace

CellIndex CellAt(const Vec2& xy_W_m, double cell_m) {
  return {static_cast<int>(std::floor(xy_W_m.x() / cell_m)),
          static_cast<int>(std::floor(xy_W_m.y() / cell_m))};
}

void AddHeightDifferences(const RangeSource& source, const SensorCalibration& calibration,
                          double scale, std::size_t scan, const std::vector<bool>& excluded,
                          double cell_m, std::vector<HeightDifference>* differences) {
  const std::vector<RangePoint>& points = source.scans[scan].points;
  const std::vector<SimulatedReturn> hits =
      source.cast(scan, calibration, BeamsOf(source.scans[scan]));
  std::vector<HeightDifference> remarkable;
  std::vector<std::size_t> remarkable_points;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (excluded[p] || hits[p].surface == Surface::kUnknown) continue;
    if (LiesOnObject(source, calibration, points[p], hits[p], scale)) continue;
    const Vec3 p_W_m = PointInWorld(source, calibration, points[p], hits[p]);
    const auto ground_m = source.ground_m(scan, p_W_m.head<2>());
    if (!ground_m || std::abs(p_W_m.z() - *ground_m) > kGreatestHeight_m) continue;
    HeightDifference one{scan, p, CellAt(p_W_m.head<2>(), cell_m), p_W_m.z() - *ground_m, {}};
    one.simulated = one.cell;
    if (hits[p].surface != Surface::kNothing) {
      const Vec3 d_W = RayDirection_W(calibration, points[p], hits[p]);
      const double short_m =
          TruePoint(source, calibration, points[p].p_S_m).norm() - hits[p].range_m;
      one.simulated = CellAt((p_W_m - short_m * d_W).head<2>(), cell_m);
    }
    if (std::abs(one.above_m) < kUnremarkable_m) {
      differences->push_back(one);
    } else if (!IsOnCliff(source, scan, p_W_m)) {
      remarkable.push_back(one);
      remarkable_points.push_back(p);
    }
  }
  const std::vector<bool> on_edge = OnOcclusionEdges(source, calibration, scan, remarkable_points);
  for (std::size_t i = 0; i < remarkable_points.size(); ++i) {
    if (!on_edge[i]) differences->push_back(remarkable[i]);
  }
}

}  // namespace tera
