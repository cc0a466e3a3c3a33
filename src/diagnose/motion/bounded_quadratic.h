#pragma once

#include <Eigen/Core>

namespace tera {

/// Minimiser of 1/2 x' A x - b' x with lower <= x <= upper. Bounds may be infinite; `A` must be
/// positive definite.
///
/// Model   primal-dual interior point for bounds only.
/// Source  Nocedal and Wright 2006, "Numerical optimization", ch. 16.6.
Eigen::VectorXd SmallestWithin(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                               const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

}  // namespace tera
