#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace tera {

/// A point found by NearestPoints.
struct FoundPoint {
  std::size_t index = 0;
  float distance_m = 0;
};

/// Exact search for the nearest of many points, by OpenCV's k-d tree.
class NearestPoints {
 public:
  explicit NearestPoints(const std::vector<Eigen::Vector3f>& points_m);
  ~NearestPoints();

  /// The `most` nearest points, or all if there are fewer, the nearest first.
  std::vector<FoundPoint> Find(const Eigen::Vector3f& point_m, std::size_t most) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;  ///< none without points
};

}  // namespace tera
