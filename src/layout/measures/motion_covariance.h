#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "core/motion.h"

namespace tera {

/// A coordinate of a machine (joint or root), modelled as a random motion.
struct RandomCoordinate {
  double prior = 0;       ///< 1 sigma of its initial position, rad or m
  double rate_sigma = 0;  ///< stationary, rad/s or m/s
};

/// A slowly varying sensor error, a first-order Gauss-Markov process:
/// x_k = e^(-T / tau) x_(k-1) + w. The variance of w is walk^2 T + (1 - e^(-2 T / tau))
/// stationary^2.
struct SlowError {
  double prior = 0;  ///< initial 1 sigma
  double walk = 0;   ///< random walk, per square root of a second
  double stationary = 0;
  double correlation_time_s = 0;  ///< tau; 0: no decay
};

/// Covariance of the best estimate of coordinates and slow sensor errors: the inverse of the Fisher
/// information.
///
/// Model   each coordinate has a position x, a rate v and an acceleration a, driven by white noise
///         u: x' = v, v' = a, a' = -v / tau^2 - 2 a / tau + u. The intensity of u is 4 sigma_v^2 /
///         tau^3. The stationary deviations are then sigma_v for v and sigma_v / tau for a.
///         Each coordinate also has its mean rate (x_k - x_(k-1)) / T and mean acceleration (v_k -
///         v_(k-1)) / T over the last step. Sensors that integrate between samples measure these
///         means.
///         The slow errors follow after all coordinates.
///         The recursion is that of a filter, J <- (Q + F J^-1 F^T)^-1 + h h^T / r. The class
///         stores J^-1 because Q is singular.
/// Omits   the information of later measurements about earlier states, which a smoother uses.
/// Source  Tichavsky, Muravchik and Nehorai 1998, "Posterior Cramer-Rao bounds for discrete-time
///         nonlinear filtering", IEEE Trans. Signal Processing 46(5), the recursion for additive
///         Gaussian noise; the process: Gelb 1974, "Applied optimal estimation", ch. 2
///         (second-order Gauss-Markov).
class MotionCovariance {
 public:
  /// Time constant tau of a coordinate: the response of a valve and its cylinder to the operator.
  static constexpr double kResponse_s = 0.3;

  /// Entries of the state for each coordinate.
  enum Number { kPosition, kRate, kAcceleration, kMeanRate, kMeanAcceleration };
  static constexpr int kNumbers = 5;

  MotionCovariance(std::vector<RandomCoordinate> coordinates, std::vector<SlowError> errors);

  Eigen::Index size() const { return P_.rows(); }
  /// State index of an entry of a coordinate.
  static Eigen::Index At(std::size_t coordinate, Number number) {
    return kNumbers * static_cast<Eigen::Index>(coordinate) + number;
  }
  Eigen::Index AtError(std::size_t error) const {
    return At(coordinates_.size(), kPosition) + static_cast<Eigen::Index>(error);
  }

  /// Propagates the state by a step of at most a third of kResponse_s.
  void Pass(double dt_s);
  /// Rotates three coordinates that form an attitude error about the axes of W.
  void Turn(std::size_t first, const Mat3& R);
  /// Adds a measurement of h^T x with white noise of this variance.
  void Learn(const Eigen::VectorXd& h, double variance);

  /// Variance of h^T x. Rounding can make a zero variance slightly negative, so it is clamped.
  double VarianceOf(const Eigen::VectorXd& h) const { return std::max(0.0, h.dot(P_ * h)); }
  double VarianceAt(Eigen::Index i) const { return std::max(0.0, P_(i, i)); }

 private:
  std::vector<RandomCoordinate> coordinates_;
  std::vector<SlowError> errors_;
  Eigen::MatrixXd P_;
};

}  // namespace tera
