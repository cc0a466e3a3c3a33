#include "dataset/compare/cloud_distance.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

#include "core/motion.h"
#include "dataset/compare/nearest_points.h"

namespace tera {
namespace {

constexpr std::size_t kNeighbours = 32;
constexpr std::size_t kMostJudged = 10'000;              ///< points evaluated per cloud
constexpr std::size_t kPatch = 200, kMostPatches = 500;  ///< sizes for DeviationsOnPlanes
constexpr double kLeastSlant = 0.5;    ///< cosine of the angle between ray and normal
constexpr double kLeastBreadth = 0.2;  ///< second principal deviation divided by the first
constexpr double kMostDepth = 0.1;     ///< third principal deviation divided by the second

Eigen::Vector3f PlaceOf(const LidarPoint& point) { return {point.x_m, point.y_m, point.z_m}; }

/// A plane fitted to points.
struct FittedPlane {
  Vec3 mean_m, normal;
};

/// Plane through the nearest of `places_m`; nullopt if they are not planar.
std::optional<FittedPlane> PlaneOf(const std::vector<Eigen::Vector3f>& places_m,
                                   const std::vector<FoundPoint>& nearest) {
  const auto n = static_cast<double>(nearest.size());
  Vec3 mean_m = Vec3::Zero();
  for (const FoundPoint& one : nearest) mean_m += places_m[one.index].cast<double>() / n;
  Mat3 scatter_m2 = Mat3::Zero();
  for (const FoundPoint& one : nearest) {
    const Vec3 away_m = places_m[one.index].cast<double>() - mean_m;
    scatter_m2 += away_m * away_m.transpose() / n;
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(scatter_m2);
  const Vec3 deviation_m = principal.eigenvalues().cwiseMax(0).cwiseSqrt();  // in ascending order
  const bool is_broad = deviation_m[2] > 0 && deviation_m[1] >= kLeastBreadth * deviation_m[2];
  if (!is_broad || deviation_m[0] > kMostDepth * deviation_m[1]) return std::nullopt;
  return FittedPlane{mean_m, principal.eigenvectors().col(0)};
}

std::vector<Eigen::Vector3f> PlacesOf(const std::vector<LidarPoint>& points) {
  std::vector<Eigen::Vector3f> places_m;
  for (const LidarPoint& point : points) places_m.push_back(PlaceOf(point));
  return places_m;
}

}  // namespace

CloudDistances DistancesFrom(const std::vector<LidarPoint>& other,
                             const std::vector<LidarPoint>& points) {
  const std::vector<Eigen::Vector3f> places_m = PlacesOf(other);
  CloudDistances distances;
  if (places_m.empty()) return distances;
  const NearestPoints nearest(places_m);
  const std::size_t step = 1 + (points.size() - 1) / kMostJudged;
  for (std::size_t k = 0; k < points.size(); k += step) {
    const Eigen::Vector3f point_m = PlaceOf(points[k]);
    const std::vector<FoundPoint> found = nearest.Find(point_m, kNeighbours);
    distances.to_point_m.push_back(static_cast<double>(found.front().distance_m));
    if (found.size() < kNeighbours) continue;
    const auto plane = PlaneOf(places_m, found);
    if (!plane) continue;
    const Vec3 away_m = point_m.cast<double>() - plane->mean_m;
    distances.to_surface_m.push_back(std::abs(plane->normal.dot(away_m)));
  }
  return distances;
}

std::vector<PlaneDeviation> DeviationsOnPlanes(const std::vector<LidarPoint>& points) {
  const std::vector<Eigen::Vector3f> places_m = PlacesOf(points);
  std::vector<PlaneDeviation> deviations;
  if (places_m.size() < kPatch) return deviations;
  const NearestPoints nearest(places_m);
  const std::size_t step = 1 + (places_m.size() - 1) / kMostPatches;
  for (std::size_t k = 0; k < places_m.size(); k += step) {
    const auto plane = PlaneOf(places_m, nearest.Find(places_m[k], kPatch));
    const Vec3 point_m = places_m[k].cast<double>();
    const double range_m = point_m.norm();
    if (!plane || range_m == 0) continue;
    const double slant = plane->normal.dot(point_m) / range_m;
    if (std::abs(slant) < kLeastSlant) continue;
    deviations.push_back({range_m, plane->normal.dot(point_m - plane->mean_m) / slant});
  }
  return deviations;
}

}  // namespace tera
