#include "survey/align/plane_map.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace tera {
namespace {

constexpr int kNeighbours = 16;
/// Flatness limit: largest variance normal to a plane, relative to the smaller variance in the
/// plane.
constexpr double kFlat = 0.04;
/// Breadth limit: least ratio of the variances in a plane. A narrower neighbourhood is a line.
constexpr double kBroad = 0.02;

LocalPlane PlaneOf(const std::vector<Vec3>& p_m, const pcl::Indices& neighbours, double radius_m) {
  const auto count = static_cast<double>(neighbours.size());
  LocalPlane plane;
  plane.radius_m = radius_m;
  for (const int k : neighbours) plane.mean_m += p_m[static_cast<std::size_t>(k)] / count;
  Mat3 spread = Mat3::Zero();
  for (const int k : neighbours) {
    const Vec3 from = p_m[static_cast<std::size_t>(k)] - plane.mean_m;
    spread += from * from.transpose() / count;
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  const Vec3 variance = axes.eigenvalues().cwiseMax(0.0);
  plane.normal = axes.eigenvectors().col(0);
  plane.across = axes.eigenvectors().col(1);
  plane.along = axes.eigenvectors().col(2);
  plane.is_plane = variance[0] <= kFlat * variance[1] && variance[1] > kBroad * variance[2];
  plane.spread_across_m2 = variance[1];
  plane.spread_along_m2 = variance[2];
  // The fit of the plane uses three degrees of freedom.
  plane.noise_m2 = variance[0] * count / (count - 3);
  plane.points = neighbours;
  return plane;
}

}  // namespace

double LocalPlane::Influence(const Vec3& at_m, const Vec3& point_m) const {
  const Vec3 at = at_m - mean_m, from = point_m - mean_m;
  return (1 + along.dot(at) * along.dot(from) / spread_along_m2 +
          across.dot(at) * across.dot(from) / spread_across_m2) /
         static_cast<double>(points.size());
}

PlaneMap::PlaneMap(std::vector<Vec3> p_m) : p_m_(std::move(p_m)), cloud_(ToPcl(p_m_)) {
  tree_.setInputCloud(cloud_);
  pcl::Indices neighbours;
  std::vector<float> squares_m2;
  for (const pcl::PointXYZ& point : *cloud_) {
    tree_.nearestKSearch(point, kNeighbours, neighbours, squares_m2);
    const bool enough = neighbours.size() >= static_cast<std::size_t>(kNeighbours);
    planes_.push_back(enough ? PlaneOf(p_m_, neighbours, std::sqrt(squares_m2.back()))
                             : LocalPlane());
  }
}

int PlaneMap::Nearest(const Vec3& p_m, double gate_m) const {
  pcl::Indices nearest;
  std::vector<float> squares_m2;
  const pcl::PointXYZ point(static_cast<float>(p_m.x()), static_cast<float>(p_m.y()),
                            static_cast<float>(p_m.z()));
  if (tree_.nearestKSearch(point, 1, nearest, squares_m2) < 1) return -1;
  return squares_m2[0] <= gate_m * gate_m ? nearest[0] : -1;
}

}  // namespace tera
