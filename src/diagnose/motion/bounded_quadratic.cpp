#include "diagnose/motion/bounded_quadratic.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr int kMostIterations = 60;
constexpr double kPrecision = 1e-12;  ///< duality gap, relative to the objective
constexpr double kGradient = 1e-6;    ///< gradient, relative to the square root of the curvature
constexpr double kStepShare = 0.995;  ///< share of the way to the nearest bound
constexpr double kLeastSlack = 1e-9;  ///< smallest start slack, in units of the variable

/// The longest step, at most 1, along which `x` stays positive.
double LongestStep(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) {
  double step = 1;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (dx[i] < 0) step = std::min(step, -kStepShare * x[i] / dx[i]);
  }
  return step;
}

}  // namespace

Eigen::VectorXd SmallestWithin(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                               const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  const Eigen::VectorXd free = A.llt().solve(b);
  if ((free.array() >= lower.array()).all() && (free.array() <= upper.array()).all()) return free;
  // The unit of a variable is the change that raises the objective by one half.
  const Eigen::VectorXd unit = A.diagonal().cwiseSqrt().cwiseInverse();
  // Each finite bound is a slack s = sign x - bound > 0 with a multiplier z > 0.
  std::vector<Eigen::Index> index;
  std::vector<double> sign, bound;
  Eigen::VectorXd x = free;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double width = upper[i] - lower[i];
    const double inset = std::isfinite(width) ? 0.05 * width : unit[i];
    x[i] = std::clamp(x[i], lower[i] + inset, upper[i] - inset);
    if (std::isfinite(lower[i])) index.push_back(i), sign.push_back(1), bound.push_back(lower[i]);
    if (std::isfinite(upper[i])) index.push_back(i), sign.push_back(-1), bound.push_back(-upper[i]);
  }
  const auto count = static_cast<Eigen::Index>(index.size());
  Eigen::VectorXd s(count), z(count), ds(count), dz(count);
  const double start = std::max(
      1e-6, (A * x - b).cwiseAbs().cwiseProduct((upper - lower).cwiseMin(unit).cwiseAbs()).mean());
  const auto at = [&](Eigen::Index k) { return index[static_cast<std::size_t>(k)]; };
  const auto way = [&](Eigen::Index k) { return sign[static_cast<std::size_t>(k)]; };
  for (Eigen::Index k = 0; k < count; ++k) {
    s[k] =
        std::max(way(k) * x[at(k)] - bound[static_cast<std::size_t>(k)], kLeastSlack * unit[at(k)]);
    z[k] = start / s[k];
  }
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const double gap = s.dot(z) / static_cast<double>(count);
    Eigen::VectorXd gradient = A * x - b;
    const double scale = 1 + 0.5 * std::abs(x.dot(gradient - b));
    for (Eigen::Index k = 0; k < count; ++k) gradient[at(k)] -= way(k) * z[k];
    if (gap * static_cast<double>(count) < kPrecision * scale &&
        gradient.cwiseProduct(unit).cwiseAbs().maxCoeff() < kGradient) {
      break;
    }
    const double target = 0.1 * gap;
    Eigen::MatrixXd H = A;
    Eigen::VectorXd right = -gradient;
    for (Eigen::Index k = 0; k < count; ++k) {
      H(at(k), at(k)) += z[k] / s[k];
      right[at(k)] += way(k) * (target / s[k] - z[k]);
    }
    const Eigen::VectorXd dx = H.llt().solve(right);
    for (Eigen::Index k = 0; k < count; ++k) {
      ds[k] = way(k) * dx[at(k)];
      dz[k] = target / s[k] - z[k] - z[k] / s[k] * ds[k];
    }
    const double step = std::min(LongestStep(s, ds), LongestStep(z, dz));
    x += step * dx;
    s += step * ds;
    z += step * dz;
  }
  return x.cwiseMax(lower).cwiseMin(upper);
}

}  // namespace tera
