#include "layout/measures/motion_covariance.h"

#include <cmath>
#include <utility>

namespace tera {
namespace {

constexpr double kW_radps = 1 / MotionCovariance::kResponse_s;

/// Response to a unit impulse in the acceleration: position, rate and acceleration after `t_s`.
Vec3 AnswerToPush(double t_s) {
  const double x = kW_radps * t_s, e = std::exp(-x);
  return {(1 - e * (1 + x)) / (kW_radps * kW_radps), e * t_s, e * (1 - x)};
}

/// Transition matrix of position, rate and acceleration: the matrix exponential of the process.
Mat3 Transition(double t_s) {
  const double x = kW_radps * t_s, e = std::exp(-x);
  Mat3 F;
  F.col(0) = Vec3::UnitX();
  F.col(1) = Vec3((2 - e * (2 + x)) / kW_radps, e * (1 + x), -kW_radps * x * e);
  F.col(2) = AnswerToPush(t_s);
  return F;
}

/// Covariance that white noise adds during `t_s` to a coordinate with a rate deviation of 1. It is
/// the integral of 4 w^3 g g^T, where g is the impulse response. Three-point Gauss-Legendre
/// quadrature evaluates it.
Mat3 Driven(double t_s) {
  const std::array<std::pair<double, double>, 3> points = {
      {{0.5 - std::sqrt(0.15), 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + std::sqrt(0.15), 5.0 / 18}}};
  Mat3 Q = Mat3::Zero();
  for (const auto& [share, weight] : points) {
    const Vec3 g = AnswerToPush(share * t_s);
    Q += weight * t_s * g * g.transpose();
  }
  return 4 * kW_radps * kW_radps * kW_radps * Q;
}

using Numbers = Eigen::Matrix<double, MotionCovariance::kNumbers, MotionCovariance::kNumbers>;

/// Transition of all entries of a coordinate. The means of the last step are discarded.
Numbers TransitionOfNumbers(double t_s) {
  Numbers F = Numbers::Zero();
  F.topLeftCorner<3, 3>() = Transition(t_s);
  F.block<2, 3>(3, 0) = (F.block<2, 3>(0, 0) - Mat3::Identity().topRows<2>()) / t_s;
  return F;
}

Numbers DrivenNumbers(double t_s) {
  Eigen::Matrix<double, MotionCovariance::kNumbers, 3> G;
  G.topRows<3>().setIdentity();
  G.bottomRows<2>() = Mat3::Identity().topRows<2>() / t_s;
  return G * Driven(t_s) * G.transpose();
}

double Kept(const SlowError& error, double dt_s) {
  return error.correlation_time_s > 0 ? std::exp(-dt_s / error.correlation_time_s) : 1;
}

}  // namespace

MotionCovariance::MotionCovariance(std::vector<RandomCoordinate> coordinates,
                                   std::vector<SlowError> errors)
    : coordinates_(std::move(coordinates)), errors_(std::move(errors)) {
  const Eigen::Index size =
      At(coordinates_.size(), kPosition) + static_cast<Eigen::Index>(errors_.size());
  P_ = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t c = 0; c < coordinates_.size(); ++c) {
    const RandomCoordinate& coordinate = coordinates_[c];
    const Vec3 sigma(coordinate.prior, coordinate.rate_sigma, kW_radps * coordinate.rate_sigma);
    P_.diagonal().segment<3>(At(c, kPosition)) = sigma.cwiseAbs2();
  }
  for (std::size_t e = 0; e < errors_.size(); ++e) {
    P_(AtError(e), AtError(e)) = errors_[e].prior * errors_[e].prior;
  }
}

void MotionCovariance::Pass(double dt_s) {
  const Numbers F = TransitionOfNumbers(dt_s), Q = DrivenNumbers(dt_s);
  for (std::size_t c = 0; c < coordinates_.size(); ++c) {
    P_.middleRows<kNumbers>(At(c, kPosition)) =
        (F * P_.middleRows<kNumbers>(At(c, kPosition))).eval();
  }
  for (std::size_t c = 0; c < coordinates_.size(); ++c) {
    P_.middleCols<kNumbers>(At(c, kPosition)) =
        (P_.middleCols<kNumbers>(At(c, kPosition)) * F.transpose()).eval();
    const double rate_sigma = coordinates_[c].rate_sigma;
    P_.block<kNumbers, kNumbers>(At(c, kPosition), At(c, kPosition)) += rate_sigma * rate_sigma * Q;
  }
  for (std::size_t e = 0; e < errors_.size(); ++e) {
    const SlowError& error = errors_[e];
    const double kept = Kept(error, dt_s);
    P_.row(AtError(e)) *= kept;
    P_.col(AtError(e)) *= kept;
    P_(AtError(e), AtError(e)) +=
        error.walk * error.walk * dt_s + (1 - kept * kept) * error.stationary * error.stationary;
  }
  P_ = (0.5 * (P_ + P_.transpose())).eval();  // removes asymmetry due to rounding
}

void MotionCovariance::Turn(std::size_t first, const Mat3& R) {
  const std::array<Eigen::Index, 3> at = {At(first, kPosition), At(first + 1, kPosition),
                                          At(first + 2, kPosition)};
  P_(at, Eigen::all) = (R * P_(at, Eigen::all)).eval();
  P_(Eigen::all, at) = (P_(Eigen::all, at) * R.transpose()).eval();
}

void MotionCovariance::Learn(const Eigen::VectorXd& h, double variance) {
  const Eigen::VectorXd Ph = P_ * h;
  P_.noalias() -= Ph * (Ph / (h.dot(Ph) + variance)).transpose();
}

}  // namespace tera
