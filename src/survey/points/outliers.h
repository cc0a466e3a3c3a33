#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

/// Which points stand alone: birds, dust, reflections in puddles.
///
/// Model   Points are put into cubes of `edge_m`, so that density counts for nothing; a cube is an
///         outlier where the mean distance to its `neighbours` next ones is more than `sigmas`
///         standard deviations above the mean of all (PCL's StatisticalOutlierRemoval), and more
///         than `spacings` times the median: on a regular grid even corners are far by deviations.
/// Source  Rusu et al. 2008, "Towards 3D point cloud based object maps for household environments".
struct OutlierRule {
  double edge_m = 0.1;
  int neighbours = 8;
  double sigmas = 4;
  double spacings = 2;
};

/// True for each point that is one.
std::vector<bool> FindOutliers(const std::vector<Vec3>& p_m, const OutlierRule& rule);

}  // namespace tera
