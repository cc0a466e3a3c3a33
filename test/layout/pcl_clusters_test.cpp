#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>
#include <random>
#include <set>

#include "layout/people_around.h"

// Clusters of the plain detector against the Point Cloud Library's. Built only where that is
// installed (libpcl-dev).

namespace tera {
namespace {

using Clusters = std::set<std::set<std::size_t>>;

/// Points of clusters, independent of their order.
Clusters Ours(const std::vector<Vec3>& points_m, double tolerance_m, std::size_t least) {
  Clusters clusters;
  for (const Cluster& cluster : EuclideanClusters(points_m, tolerance_m, least)) {
    clusters.insert({cluster.begin(), cluster.end()});
  }
  return clusters;
}

Clusters OfPcl(const std::vector<Vec3>& points_m, double tolerance_m, std::size_t least) {
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const Vec3& p_m : points_m) {
    cloud->emplace_back(float(p_m.x()), float(p_m.y()), float(p_m.z()));
  }
  const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  tree->setInputCloud(cloud);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(tolerance_m);
  extraction.setMinClusterSize(static_cast<int>(least));
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> found;
  extraction.extract(found);
  Clusters clusters;
  for (const pcl::PointIndices& cluster : found) {
    clusters.insert({cluster.indices.begin(), cluster.indices.end()});
  }
  return clusters;
}

TEST(EuclideanClusters, AreThoseOfThePointCloudLibrary) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place_m(-6, 6);
  std::vector<Vec3> points_m;
  for (int i = 0; i < 3000; ++i) {
    // In single precision, so that both detectors agree on which distances are within tolerance.
    const Vec3 p_m(place_m(random), place_m(random), 0.1 * place_m(random));
    points_m.push_back(p_m.cast<float>().cast<double>());
  }
  std::size_t most = 0;
  for (const double tolerance_m : {0.1, 0.2, 0.3, 0.5}) {
    for (const std::size_t least : {std::size_t{1}, std::size_t{5}}) {
      const Clusters ours = Ours(points_m, tolerance_m, least);
      EXPECT_EQ(ours, OfPcl(points_m, tolerance_m, least)) << tolerance_m << " m, " << least;
      most = std::max(most, ours.size());
    }
  }
  EXPECT_GT(most, 1000u);
}

TEST(EuclideanClusters, OfScansOfPeopleAreThoseOfThePointCloudLibrary) {
  const PeopleAround site;
  std::size_t clusters = 0;
  for (const std::string lidar : {"os1_64", "vlp16"}) {
    site.Resense(lidar, lidar, "xyz_m: [0.05, 0.35, 2.3], rpy_deg: [0, 10, 0]");
    const Recording recording(site.Data(lidar));
    const std::vector<TimeNs> times_ns = recording.FrameTimes("excavator1/lidar");
    const PeopleDetector detector;
    const Pose X_HS = MakePose(Vec3(0, 0, 2.9), 0, 10 * kDeg, 0);
    for (std::size_t k = 0; k < times_ns.size(); k += 20) {
      const std::vector<Vec3> points_H_m =
          detector.Standing(recording.LoadScan("excavator1/lidar", times_ns[k]), X_HS);
      const Clusters ours = Ours(points_H_m, detector.tolerance_m, detector.least);
      EXPECT_EQ(ours, OfPcl(points_H_m, detector.tolerance_m, detector.least)) << lidar << k;
      clusters += ours.size();
    }
  }
  EXPECT_GT(clusters, 50u);
}

}  // namespace
}  // namespace tera
