#pragma once

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Indices of the points of one cluster.
using Cluster = std::vector<std::size_t>;

/// Points in cubes with edges of `edge_m`.
class PointCubes {
 public:
  PointCubes(const std::vector<Vec3>& points_m, double edge_m)
      : points_m_(points_m), edge_m_(edge_m) {
    for (std::size_t i = 0; i < points_m.size(); ++i) cubes_[CubeOf(points_m[i])].push_back(i);
  }

  /// Removes all points within an edge of point `i`.
  std::vector<std::size_t> TakeNear(std::size_t i) {
    std::vector<std::size_t> near;
    const auto [x, y, z] = CubeOf(points_m_[i]);
    for (long dx = -1; dx <= 1; ++dx) {
      for (long dy = -1; dy <= 1; ++dy) {
        for (long dz = -1; dz <= 1; ++dz) {
          const auto cube = cubes_.find({x + dx, y + dy, z + dz});
          if (cube == cubes_.end()) continue;
          std::erase_if(cube->second, [&](std::size_t j) {
            const bool is_near = (points_m_[j] - points_m_[i]).norm() <= edge_m_;
            if (is_near) near.push_back(j);
            return is_near;
          });
        }
      }
    }
    return near;
  }

 private:
  std::array<long, 3> CubeOf(const Vec3& p_m) const {
    const auto at = [&](double m) { return std::lround(std::floor(m / edge_m_)); };
    return {at(p_m.x()), at(p_m.y()), at(p_m.z())};
  }

  const std::vector<Vec3>& points_m_;
  double edge_m_;
  std::map<std::array<long, 3>, std::vector<std::size_t>> cubes_;
};

/// Euclidean clusters: two points belong together if steps of at most `tolerance_m` between points
/// connect them. Only clusters of `least` points or more.
///
/// Source  Rusu, Semantic 3D Object Maps for Everyday Manipulation in Human Living Environments
///         (2009), as in pcl::EuclideanClusterExtraction. pcl_clusters_test, built where the Point
///         Cloud Library is installed, shows equality point by point.
inline std::vector<Cluster> EuclideanClusters(const std::vector<Vec3>& points_m, double tolerance_m,
                                              std::size_t least) {
  PointCubes left(points_m, tolerance_m);
  std::vector<bool> taken(points_m.size(), false);
  std::vector<Cluster> clusters;
  for (std::size_t first = 0; first < points_m.size(); ++first) {
    if (taken[first]) continue;
    Cluster cluster = left.TakeNear(first);
    for (std::size_t next = 0; next < cluster.size(); ++next) {
      taken[cluster[next]] = true;
      for (const std::size_t j : left.TakeNear(cluster[next])) cluster.push_back(j);
    }
    if (cluster.size() >= least) clusters.push_back(std::move(cluster));
  }
  return clusters;
}

}  // namespace tera
