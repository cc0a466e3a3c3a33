#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

/// Rule for isolated points, such as birds, dust and reflections in puddles.
///
/// Model   Points are grouped into cubes with edge `edge_m`, so that density has no effect. A cube
///         is an outlier if the mean distance to its `neighbours` nearest cubes exceeds two limits:
///         the mean over all cubes plus `sigmas` standard deviations (PCL's
///         StatisticalOutlierRemoval), and `spacings` times the median. The second limit protects
///         the corners of a regular grid, which exceed the first.
/// Source  Rusu et al. 2008, "Towards 3D point cloud based object maps for household environments".
struct OutlierRule {
  double edge_m = 0.1;
  int neighbours = 8;
  double sigmas = 4;
  double spacings = 2;
};

/// True for each point in an outlier cube.
std::vector<bool> FindOutliers(const std::vector<Vec3>& p_m, const OutlierRule& rule);

}  // namespace tera
