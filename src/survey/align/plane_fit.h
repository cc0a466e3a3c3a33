#pragma once

#include <vector>

#include "survey/align/plane_map.h"
#include "survey/align/six_motions.h"

namespace tera {

/// Least-squares system of the point-to-plane distances from B to A at one pose.
///
/// Frames  A. Rotations are about `centre_m` and scaled by `reach_m`, so that all six motions are
///         in metres.
struct PlaneFit {
  Vec3 centre_m = Vec3::Zero();
  double reach_m = 1;
  Mat6 information = Mat6::Zero();  ///< H: sum of w J' J
  Mat6 noise = Mat6::Zero();        ///< N: the part of H that stems from noise of the normals
  Mat6 scatter = Mat6::Zero();      ///< M: covariance of the gradient (registration.h)
  Vec6 gradient = Vec6::Zero();     ///< sum of w J' r
  double residual_m = 0;            ///< root of the weighted mean of r^2
  int partners = 0;
};

/// `b_m` are B's points in frame A. Partners are at most `gate_m` apart.
PlaneFit FitPlanes(const PlaneMap& a, const std::vector<Vec3>& b_m, double gate_m);

/// Bases of the motions that a fit determines (`told`) and of those that it leaves open. Columns
/// are orthonormal in the metres of the fit.
struct ToldMotions {
  Eigen::Matrix<double, 6, Eigen::Dynamic> told, open;
};
ToldMotions SplitMotions(const PlaneFit& fit);

}  // namespace tera
