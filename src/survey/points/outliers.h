#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

/// Rule for isolated points: birds, dust, reflections in puddles.
///
/// Model   Points are grouped into cubes of `edge_m`, so density has no effect. A cube is an
///         outlier if the mean distance to its `neighbours` nearest cubes exceeds two bounds. One
///         is `sigmas` standard deviations above the mean of all cubes (PCL's
///         StatisticalOutlierRemoval). The other is `spacings` times the median, since on a regular
///         grid even corners exceed the first.
/// Source  Rusu et al. 2008, "Towards 3D point cloud based object maps for household environments".
struct OutlierRule {
  double edge_m = 0.1;
  int neighbours = 8;
  double sigmas = 4;
  double spacings = 2;
};

/// True for each point that is an outlier.
std::vector<bool> FindOutliers(const std::vector<Vec3>& p_m, const OutlierRule& rule);

}  // namespace tera
