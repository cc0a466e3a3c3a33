#include "dataset/compare/cloud_distance.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

#include "core/motion.h"
#include "dataset/compare/nearest_points.h"

namespace tera {
namespace {

constexpr std::size_t kNeighbours = 32;
constexpr std::size_t kMostJudged = 10'000;  ///< points of one cloud
constexpr double kLeastBreadth = 0.2;        ///< second over first principal deviation
constexpr double kMostDepth = 0.1;           ///< third over second principal deviation

Eigen::Vector3f PlaceOf(const LidarPoint& point) { return {point.x_m, point.y_m, point.z_m}; }

/// The distance of a point from the plane through its neighbours, if they lie in one.
std::optional<double> PlaneDistance_m(const Vec3& point_m, const std::vector<Vec3>& neighbours_m) {
  const auto n = static_cast<double>(neighbours_m.size());
  Vec3 mean_m = Vec3::Zero();
  for (const Vec3& p_m : neighbours_m) mean_m += p_m / n;
  Mat3 scatter_m2 = Mat3::Zero();
  for (const Vec3& p_m : neighbours_m) {
    scatter_m2 += (p_m - mean_m) * (p_m - mean_m).transpose() / n;
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(scatter_m2);
  const Vec3 deviation_m = principal.eigenvalues().cwiseMax(0).cwiseSqrt();  // ascending
  const bool is_broad = deviation_m[2] > 0 && deviation_m[1] >= kLeastBreadth * deviation_m[2];
  if (!is_broad || deviation_m[0] > kMostDepth * deviation_m[1]) return std::nullopt;
  return std::abs(principal.eigenvectors().col(0).dot(point_m - mean_m));
}

}  // namespace

CloudDistances DistancesFrom(const std::vector<LidarPoint>& other,
                             const std::vector<LidarPoint>& points) {
  std::vector<Eigen::Vector3f> places_m;
  for (const LidarPoint& point : other) places_m.push_back(PlaceOf(point));
  CloudDistances distances;
  if (places_m.empty()) return distances;
  const NearestPoints nearest(places_m);
  const std::size_t step = 1 + (points.size() - 1) / kMostJudged;
  for (std::size_t k = 0; k < points.size(); k += step) {
    const Eigen::Vector3f point_m = PlaceOf(points[k]);
    const std::vector<FoundPoint> found = nearest.Find(point_m, kNeighbours);
    distances.to_point_m.push_back(static_cast<double>(found.front().distance_m));
    if (found.size() < kNeighbours) continue;
    std::vector<Vec3> neighbours_m;
    for (const FoundPoint& one : found) neighbours_m.push_back(places_m[one.index].cast<double>());
    const auto distance_m = PlaneDistance_m(point_m.cast<double>(), neighbours_m);
    if (distance_m) distances.to_surface_m.push_back(*distance_m);
  }
  return distances;
}

}  // namespace tera
