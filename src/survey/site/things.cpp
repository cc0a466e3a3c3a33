#include "survey/site/things.h"

#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <pcl/segmentation/impl/extract_clusters.hpp>

#include "survey/points/pcl_cloud.h"
#include "survey/points/voxels.h"

namespace tera {
namespace {

/// Cluster of each point; -1 for none.
std::vector<int> Cluster(const std::vector<Vec3>& p_m, const ThingRule& rule) {
  const Voxels voxels = GroupByVoxel(p_m, rule.voxel_m);
  const PclCloud::Ptr cloud = ToPcl(voxels.mean_m);
  auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  tree->setInputCloud(cloud);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud);
  extraction.setSearchMethod(tree);
  extraction.setClusterTolerance(rule.gap_m);
  extraction.setMinClusterSize(rule.least_voxels);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  std::vector<int> of_voxel(voxels.count.size(), -1);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    for (const int voxel : clusters[c].indices) {
      of_voxel[static_cast<std::size_t>(voxel)] = static_cast<int>(c);
    }
  }
  std::vector<int> of_point;
  for (const int voxel : voxels.of_point) {
    of_point.push_back(of_voxel[static_cast<std::size_t>(voxel)]);
  }
  return of_point;
}

double LowestGround(const Footprint& footprint, const SurveyTerrain& terrain) {
  const Vec2 along(std::cos(footprint.yaw_rad), std::sin(footprint.yaw_rad));
  const Vec2 across(-along.y(), along.x());
  double lowest_m = terrain.HeightAt(footprint.middle_m);
  for (const double a : {-0.5, 0.5}) {
    for (const double b : {-0.5, 0.5}) {
      const Vec2 corner =
          footprint.middle_m + a * footprint.length_m * along + b * footprint.width_m * across;
      lowest_m = std::min(lowest_m, terrain.HeightAt(corner));
    }
  }
  return lowest_m;
}

}  // namespace

std::vector<SurveyThing> FindThings(const std::vector<Vec3>& p_m, const std::vector<float>& above_m,
                                    const SurveyTerrain& terrain, const ThingRule& rule) {
  std::vector<Vec3> standing_m;
  for (std::size_t k = 0; k < p_m.size(); ++k) {
    if (above_m[k] > 0) standing_m.push_back(p_m[k]);
  }
  if (standing_m.empty()) return {};
  const std::vector<int> cluster = Cluster(standing_m, rule);
  const int count = 1 + *std::max_element(cluster.begin(), cluster.end());
  std::vector<std::vector<Vec2>> places_m(static_cast<std::size_t>(count));
  std::vector<double> top_m(static_cast<std::size_t>(count),
                            -std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < standing_m.size(); ++k) {
    if (cluster[k] < 0) continue;
    const auto c = static_cast<std::size_t>(cluster[k]);
    places_m[c].push_back(standing_m[k].head<2>());
    top_m[c] = std::max(top_m[c], standing_m[k].z());
  }
  constexpr double kThinnest_m = 0.05;
  std::vector<SurveyThing> things;
  for (std::size_t c = 0; c < places_m.size(); ++c) {
    SurveyThing thing;
    thing.points = static_cast<std::int64_t>(places_m[c].size());
    thing.footprint = LeastRectangle(std::move(places_m[c]));
    thing.footprint.length_m = std::max(thing.footprint.length_m, kThinnest_m);
    thing.footprint.width_m = std::max(thing.footprint.width_m, kThinnest_m);
    thing.ground_m = terrain.HeightAt(thing.footprint.middle_m);
    thing.foot_m = LowestGround(thing.footprint, terrain);
    thing.top_m = top_m[c];
    things.push_back(thing);
  }
  const auto volume = [](const SurveyThing& thing) {
    return thing.footprint.length_m * thing.footprint.width_m * (thing.top_m - thing.foot_m);
  };
  std::stable_sort(things.begin(), things.end(), [&](const SurveyThing& a, const SurveyThing& b) {
    return volume(a) > volume(b);
  });
  return things;
}

}  // namespace tera
