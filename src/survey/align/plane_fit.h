#pragma once

#include <vector>

#include "survey/align/plane_map.h"
#include "survey/align/six_motions.h"

namespace tera {

/// The distances of B's points from A's planes at one pose, and what they say of it.
///
/// Frames  A; rotations about `centre_m` and times `reach_m`, so that all six are metres.
struct PlaneFit {
  Vec3 centre_m = Vec3::Zero();
  double reach_m = 1;
  Mat6 information = Mat6::Zero();  ///< H: sum of w J' J
  Mat6 noise = Mat6::Zero();        ///< what noise of the normals alone brings to it
  Mat6 scatter = Mat6::Zero();      ///< covariance of the gradient (registration.h)
  Vec6 gradient = Vec6::Zero();     ///< sum of w J' r
  double residual_m = 0;            ///< root of the weighted mean of r^2
  int partners = 0;
};

/// `b_m` are B's points as they lie in A; partners are no farther than `gate_m`.
PlaneFit FitPlanes(const PlaneMap& a, const std::vector<Vec3>& b_m, double gate_m);

/// What a fit tells and what it leaves open: a basis of each, columns orthonormal in the fit's
/// metres.
struct ToldMotions {
  Eigen::Matrix<double, 6, Eigen::Dynamic> told, open;
};
ToldMotions SplitMotions(const PlaneFit& fit);

}  // namespace tera
