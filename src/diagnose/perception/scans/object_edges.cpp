#include "diagnose/perception/scans/object_edges.h"

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kEdge_m = 0.3;
constexpr double kEdgeTurns_rad[] = {0.4 * kDeg, 1.2 * kDeg};
constexpr int kDirections = 8;

}  // namespace

std::vector<bool> OnEdges(const RangeSource& source, const SensorNumbers& numbers, std::size_t scan,
                          const std::vector<std::size_t>& points) {
  std::vector<Beam> beams;
  for (const std::size_t p : points) {
    const Beam straight = BeamOf(source.scans[scan].points[p]);
    const Vec3 aside = straight.d_S.unitOrthogonal(), other = straight.d_S.cross(aside);
    for (const double turn_rad : kEdgeTurns_rad) {
      for (int k = 0; k < kDirections; ++k) {
        const double angle_rad = 2 * kPi * k / kDirections;
        const Vec3 to = std::cos(angle_rad) * aside + std::sin(angle_rad) * other;
        beams.push_back({(straight.d_S + turn_rad * to).normalized(), straight.since_ns});
      }
    }
  }
  const std::vector<SimulatedReturn> hits = source.cast(scan, numbers, beams);
  const std::size_t each = points.empty() ? 1 : beams.size() / points.size();
  std::vector<bool> on_edge(points.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const bool object = hits[i].surface != Surface::kGround && hits[i].surface != Surface::kNothing;
    const double true_m =
        TruePoint(source, numbers, source.scans[scan].points[points[i / each]].p_S_m).norm();
    // What is unknown may be a track, or soil in a bucket.
    if (object && (hits[i].range_m == 0 || std::abs(hits[i].range_m - true_m) < kEdge_m)) {
      on_edge[i / each] = true;
    }
  }
  return on_edge;
}

std::vector<Beam> BeamsOf(const RangeScan& scan) {
  std::vector<Beam> beams;
  for (const RangePoint& point : scan.points) beams.push_back(BeamOf(point));
  return beams;
}

}  // namespace tera
