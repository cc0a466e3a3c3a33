#include "diagnose/perception/scene/occlusion_edges.h"

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kSameRange_m = 0.3;  ///< of an object beside the ray and the measured point
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

}  // namespace tera
