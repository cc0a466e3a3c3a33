#include <gtest/gtest.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include <random>

#include "dataset/compare/cloud_distance.h"

// Distances between clouds, judged by the Point Cloud Library's search.

namespace tera {
namespace {

std::vector<LidarPoint> Cloud(unsigned seed, std::size_t count) {
  std::mt19937 random(seed);
  std::normal_distribution<float> place(0, 8);
  std::vector<LidarPoint> points(count);
  for (LidarPoint& p : points) {
    p.x_m = place(random), p.y_m = place(random), p.z_m = 0.1F * place(random);
  }
  return points;
}

TEST(CloudDistanceJudge, PclFindsTheSameNearestDistances) {
  const std::vector<LidarPoint> other = Cloud(1, 5000), points = Cloud(2, 3000);
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const LidarPoint& p : other) cloud->push_back({p.x_m, p.y_m, p.z_m});
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  const CloudDistances ours = DistancesFrom(other, points);
  ASSERT_EQ(ours.to_point_m.size(), points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    pcl::Indices index(1);
    std::vector<float> square_m2(1);
    tree.nearestKSearch(pcl::PointXYZ(points[k].x_m, points[k].y_m, points[k].z_m), 1, index,
                        square_m2);
    EXPECT_NEAR(ours.to_point_m[k], std::sqrt(static_cast<double>(square_m2[0])), 1e-5) << k;
  }
}

}  // namespace
}  // namespace tera
