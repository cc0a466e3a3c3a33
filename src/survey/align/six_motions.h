#pragma once

#include <Eigen/Core>

namespace tera {

/// Vectors and matrices over the six motions of a rigid body: three translations, then three
/// rotations.
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

}  // namespace tera
