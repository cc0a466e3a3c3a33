#pragma once

#include <Eigen/Core>

namespace tera {

/// The smallest 1/2 x' A x - b' x with lower <= x <= upper; bounds may be infinite. `A` must be
/// positive definite.
///
/// Model   a primal-dual interior point for bounds alone.
/// Source  Nocedal and Wright 2006, "Numerical optimization", ch. 16.6.
Eigen::VectorXd SmallestWithin(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                               const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

}  // namespace tera
