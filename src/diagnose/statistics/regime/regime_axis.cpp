#include "diagnose/statistics/regime/regime_axis.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/check.h"
#include "core/units.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr Eigen::Index kBins = 64;
constexpr std::size_t kMostLevels = 12;  ///< largest number of values of a discrete variable

/// The distinct values; none where they are too many.
std::vector<double> LevelsOf(const Series& series) {
  std::set<double> levels;
  for (std::size_t k = 0; k < series.size(); ++k) {
    if (series.valid[k]) levels.insert(series.value[k]);
    if (levels.size() > kMostLevels) return {};
  }
  return {levels.begin(), levels.end()};
}

std::size_t LengthOf(std::vector<double> value) {
  double mean = 0;
  for (const double x : value) mean += x / static_cast<double>(value.size());
  const std::size_t direct = CorrelationLength(value);
  for (double& x : value) x = std::abs(x - mean);
  return std::max(direct, CorrelationLength(value));
}

/// Cubic B-spline on unit knots, support (-2, 2).
double CubicBSpline(double x) {
  const double a = std::abs(x);
  if (a >= 2) return 0;
  if (a >= 1) return (2 - a) * (2 - a) * (2 - a) / 6;
  return 2.0 / 3 - a * a + a * a * a / 2;
}

}  // namespace

RegimeAxis::RegimeAxis(const RegimeVariable& variable)
    : times_(Eigen::VectorXd::Ones(static_cast<Eigen::Index>(variable.series.size()))),
      angle_(variable.angle),
      has_times_(!variable.times.empty()) {
  TERA_CHECK(variable.series.size() > 0);
  if (has_times_) {
    TERA_CHECK(variable.times.size() == variable.series.size(), variable.times.size());
    times_ = Eigen::Map<const Eigen::VectorXd>(variable.times.data(), times_.size());
  }
  std::vector<double> value = BridgedValues(variable.series);
  const std::vector<double> levels = LevelsOf(variable.series);
  bin_.resize(value.size());
  double low = 0;
  if (!angle_ && !levels.empty()) {
    discrete_ = true;
    centre_ =
        Eigen::Map<const Eigen::VectorXd>(levels.data(), static_cast<Eigen::Index>(levels.size()));
  } else {
    if (angle_) {
      for (double& x : value) x = std::remainder(x, 2 * kPi);
    }
    low = angle_ ? -kPi : Quantile(value, 0.002);
    const double high = angle_ ? kPi : Quantile(value, 0.998);
    width_ = std::max((high - low) / kBins, 1e-300);
    centre_ = Eigen::VectorXd::LinSpaced(kBins, low + width_ / 2, high - width_ / 2);
  }
  count_ = Eigen::VectorXd::Zero(centre_.size());
  for (std::size_t k = 0; k < value.size(); ++k) {
    Eigen::Index bin = 0;
    if (discrete_) {
      // The nearest level: an interpolated gap may lie between two.
      (centre_.array() - value[k]).abs().minCoeff(&bin);
    } else {
      const double place = std::floor((value[k] - low) / width_);
      bin = static_cast<Eigen::Index>(std::clamp(place, 0.0, static_cast<double>(kBins - 1)));
    }
    bin_[k] = static_cast<std::uint8_t>(bin);
    ++count_[bin];
  }
  if (angle_) {
    std::vector<double> sine(value.size()), cosine(value.size());
    std::transform(value.begin(), value.end(), sine.begin(), [](double x) { return std::sin(x); });
    std::transform(value.begin(), value.end(), cosine.begin(),
                   [](double x) { return std::cos(x); });
    correlation_length_ = std::max(CorrelationLength(sine), CorrelationLength(cosine));
  } else {
    correlation_length_ = LengthOf(std::move(value));
  }
}

Eigen::MatrixXd RegimeAxis::Splines(Eigen::Index wanted) const {
  if (discrete_) return Eigen::MatrixXd::Identity(bins(), bins());
  Eigen::MatrixXd splines = Eigen::MatrixXd::Zero(bins(), wanted);
  const Eigen::Index pieces = angle_ ? wanted : wanted - 3;
  TERA_CHECK(pieces >= 1, wanted);
  for (Eigen::Index b = 0; b < bins(); ++b) {
    const double x =
        (static_cast<double>(b) + 0.5) / static_cast<double>(bins()) * static_cast<double>(pieces);
    for (Eigen::Index j = -1; j <= pieces + 1; ++j) {
      const Eigen::Index column = angle_ ? (j + wanted) % wanted : j + 1;
      if (column < wanted) splines(b, column) += CubicBSpline(x - static_cast<double>(j));
    }
  }
  return splines;
}

Eigen::MatrixXd RegimeAxis::Roughness(Eigen::Index wanted) const {
  if (discrete_) return Eigen::MatrixXd::Identity(bins(), bins());
  const Eigen::Index rows = angle_ ? wanted : wanted - 2;
  Eigen::MatrixXd difference = Eigen::MatrixXd::Zero(rows, wanted);
  for (Eigen::Index r = 0; r < rows; ++r) {
    difference(r, r) += 1;
    difference(r, (r + 1) % wanted) -= 2;
    difference(r, (r + 2) % wanted) += 1;
  }
  return difference.transpose() * difference;
}

Eigen::VectorXd SumByBin(const RegimeAxis& axis, const Eigen::VectorXd& value) {
  TERA_CHECK(static_cast<std::size_t>(value.size()) == axis.samples(), value.size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(axis.bins());
  for (Eigen::Index k = 0; k < value.size(); ++k) {
    sum[axis.bin()[static_cast<std::size_t>(k)]] += axis.times()[k] * value[k];
  }
  return sum;
}

}  // namespace tera
