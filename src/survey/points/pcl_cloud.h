#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <vector>

#include "core/motion.h"

namespace tera {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

/// Converts points to PCL's single precision. Coordinates should be small.
inline PclCloud::Ptr ToPcl(const std::vector<Vec3>& p_m) {
  auto cloud = std::make_shared<PclCloud>();
  cloud->reserve(p_m.size());
  for (const Vec3& p : p_m) {
    cloud->push_back(pcl::PointXYZ(static_cast<float>(p.x()), static_cast<float>(p.y()),
                                   static_cast<float>(p.z())));
  }
  return cloud;
}

}  // namespace tera
