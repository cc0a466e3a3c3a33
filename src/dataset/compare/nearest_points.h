#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace tera {

struct FoundPoint {
  std::size_t index = 0;
  float distance_m = 0;
};

/// Exact nearest-neighbour search in a point set, by OpenCV's k-d tree.
class NearestPoints {
 public:
  explicit NearestPoints(const std::vector<Eigen::Vector3f>& points_m);
  ~NearestPoints();

  /// The `most` nearest points, nearest first; all points if there are fewer.
  std::vector<FoundPoint> Find(const Eigen::Vector3f& point_m, std::size_t most) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;  ///< null if there are no points
};

}  // namespace tera
