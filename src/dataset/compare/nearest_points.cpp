#include "dataset/compare/nearest_points.h"

#include <algorithm>
#include <cmath>
#include <opencv2/flann.hpp>

namespace tera {
namespace {

using SquaredDistance = cvflann::L2_Simple<float>;

/// Read-only view of numbers for FLANN.
cvflann::Matrix<float> RowsOf(const float* numbers, std::size_t rows) {
  return {const_cast<float*>(numbers), rows, 3};
}

}  // namespace

struct NearestPoints::Tree {
  explicit Tree(const std::vector<Eigen::Vector3f>& points_m)
      : points(points_m),
        index(RowsOf(points.front().data(), points.size()), cvflann::KDTreeSingleIndexParams()) {
    index.buildIndex();
  }

  std::vector<Eigen::Vector3f> points;
  cvflann::KDTreeSingleIndex<SquaredDistance> index;
};

NearestPoints::NearestPoints(const std::vector<Eigen::Vector3f>& points_m)
    : tree_(points_m.empty() ? nullptr : std::make_unique<Tree>(points_m)) {}

NearestPoints::~NearestPoints() = default;

std::vector<FoundPoint> NearestPoints::Find(const Eigen::Vector3f& point_m,
                                            std::size_t most) const {
  if (!tree_) return {};
  const std::size_t count = std::min(most, tree_->points.size());
  std::vector<int> indices(count);
  std::vector<float> squares_m2(count);
  cvflann::Matrix<int> index_row(indices.data(), 1, count);
  cvflann::Matrix<float> square_row(squares_m2.data(), 1, count);
  tree_->index.knnSearch(RowsOf(point_m.data(), 1), index_row, square_row, static_cast<int>(count),
                         cvflann::SearchParams());
  std::vector<FoundPoint> found;
  for (std::size_t k = 0; k < count; ++k) {
    found.push_back({static_cast<std::size_t>(indices[k]), std::sqrt(squares_m2[k])});
  }
  return found;
}

}  // namespace tera
