#include "survey/points/outliers.h"

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/kdtree/kdtree_flann.h>

#include <cmath>
#include <pcl/filters/impl/filter_indices.hpp>
#include <pcl/filters/impl/statistical_outlier_removal.hpp>

#include "core/quantile.h"
#include "survey/points/pcl_cloud.h"
#include "survey/points/voxels.h"

namespace tera {
namespace {

/// Distances from points to their nearest neighbours.
class Spacing {
 public:
  Spacing(const PclCloud::Ptr& cloud, int neighbours) : cloud_(cloud), neighbours_(neighbours) {
    tree_.setInputCloud(cloud);
  }
  double MeanOf(int point) const {
    pcl::Indices nearest;
    std::vector<float> squares_m2;
    tree_.nearestKSearch((*cloud_)[static_cast<std::size_t>(point)], neighbours_ + 1, nearest,
                         squares_m2);
    double sum_m = 0;
    for (const float square_m2 : squares_m2) sum_m += std::sqrt(square_m2);
    return sum_m / neighbours_;
  }
  /// Median over about a thousand of the points.
  double Typical(const pcl::Indices& points) const {
    constexpr std::size_t kSample = 1000;
    std::vector<double> means_m;
    for (std::size_t k = 0; k < points.size(); k += 1 + points.size() / kSample) {
      means_m.push_back(MeanOf(points[k]));
    }
    return Median(std::move(means_m));
  }

 private:
  PclCloud::Ptr cloud_;
  int neighbours_;
  pcl::KdTreeFLANN<pcl::PointXYZ> tree_;
};

}  // namespace

std::vector<bool> FindOutliers(const std::vector<Vec3>& p_m, const OutlierRule& rule) {
  std::vector<bool> is_outlier(p_m.size(), false);
  const Voxels voxels = GroupByVoxel(p_m, rule.edge_m);
  // With fewer cubes than neighbours, there are no outliers.
  if (voxels.count.size() <= static_cast<std::size_t>(rule.neighbours)) return is_outlier;
  const PclCloud::Ptr cloud = ToPcl(voxels.mean_m);
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter(true);
  filter.setInputCloud(cloud);
  filter.setMeanK(rule.neighbours);
  filter.setStddevMulThresh(rule.sigmas);
  pcl::Indices kept;
  filter.filter(kept);
  const pcl::Indices& removed = *filter.getRemovedIndices();
  if (kept.empty() || removed.empty()) return is_outlier;
  const Spacing spacing(cloud, rule.neighbours);
  const double least_m = rule.spacings * spacing.Typical(kept);
  std::vector<bool> is_out(voxels.count.size(), false);
  for (const int voxel : removed) {
    is_out[static_cast<std::size_t>(voxel)] = spacing.MeanOf(voxel) > least_m;
  }
  for (std::size_t k = 0; k < p_m.size(); ++k) {
    is_outlier[k] = is_out[static_cast<std::size_t>(voxels.of_point[k])];
  }
  return is_outlier;
}

}  // namespace tera
