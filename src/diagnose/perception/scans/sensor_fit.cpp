#include "diagnose/perception/scans/sensor_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/units.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

using Vector = Eigen::Matrix<double, SensorNumbers::kCount, 1>;
using Matrix = Eigen::Matrix<double, SensorNumbers::kCount, SensorNumbers::kCount>;

constexpr double kDof = 4;
constexpr double kFurthest = 30;  ///< sigmas: a point further away is no further evidence
constexpr int kRounds = 9, kCoarseRounds = 4;
constexpr double kWide = 2;              ///< times the robust scale, to begin with
constexpr double kNarrowing = 0.4;       ///< of the scale, from one round to the next
constexpr double kStill = 1e-3;          ///< of the prior: a step so short ends the rounds
constexpr double kLargestStep = 1;       ///< of the prior's standard deviation
constexpr double kLeastScale = 0.2;      ///< noise cannot be far below the model's
constexpr std::size_t kFewestScans = 5;  ///< for a scatter

const std::array<double, SensorNumbers::kCount> kPrior = {0.3,      0.3, 0.3,  5 * kDeg, 5 * kDeg,
                                                          5 * kDeg, 0.3, 0.05, 1};

double WeightOf(const PointResidual& residual, double scale) {
  const double x = residual.beyond / (scale * residual.sigma);
  return (kDof + 1) / (kDof + x * x);
}

struct NormalEquations {
  Matrix information = Matrix::Zero();
  Vector score = Vector::Zero();
  std::map<std::size_t, Vector> score_of_scan;
};

NormalEquations EquationsOf(const std::vector<PointResidual>& residuals, double scale) {
  NormalEquations equations;
  for (const PointResidual& r : residuals) {
    if (!r.is_judged()) continue;
    const double over = WeightOf(r, scale) / std::pow(scale * r.sigma, 2);
    equations.information.selfadjointView<Eigen::Lower>().rankUpdate(r.slope, over);
    const Vector score = -over * r.beyond * r.slope;
    equations.score += score;
    equations.score_of_scan.try_emplace(r.scan, Vector::Zero()).first->second += score;
  }
  equations.information = equations.information.selfadjointView<Eigen::Lower>();
  return equations;
}

/// Rows and columns of numbers that are not free are those of a unit matrix.
Matrix OnlyFree(Matrix matrix, const FreeNumbers& is_free) {
  for (int i = 0; i < SensorNumbers::kCount; ++i) {
    if (is_free[static_cast<std::size_t>(i)]) continue;
    matrix.row(i).setZero();
    matrix.col(i).setZero();
    matrix(i, i) = 1;
  }
  return matrix;
}

Matrix PriorInformation() {
  Matrix prior = Matrix::Zero();
  for (int i = 0; i < SensorNumbers::kCount; ++i) {
    prior(i, i) = std::pow(kPrior[static_cast<std::size_t>(i)], -2);
  }
  return prior;
}

/// One step of Gauss and Newton; its length, in standard deviations of the prior.
double Step(const NormalEquations& equations, const FreeNumbers& is_free,
            const SensorNumbers& start, SensorNumbers* numbers) {
  const Matrix prior = PriorInformation();
  Vector away;
  for (std::size_t i = 0; i < SensorNumbers::kCount; ++i) {
    away[static_cast<Eigen::Index>(i)] = numbers->value[i] - start.value[i];
  }
  Vector score = equations.score - prior * away;
  for (std::size_t i = 0; i < SensorNumbers::kCount; ++i) {
    if (!is_free[i]) score[static_cast<Eigen::Index>(i)] = 0;
  }
  const Vector step = OnlyFree(equations.information + prior, is_free).ldlt().solve(score);
  double length = 0;
  for (std::size_t i = 0; i < SensorNumbers::kCount; ++i) {
    length = std::max(length, std::abs(step[static_cast<Eigen::Index>(i)]) / kPrior[i]);
  }
  const double shorten = length > kLargestStep ? kLargestStep / length : 1;
  for (std::size_t i = 0; i < SensorNumbers::kCount; ++i) {
    numbers->value[i] += shorten * step[static_cast<Eigen::Index>(i)];
  }
  return length;
}

FreeNumbers TurningAlone(FreeNumbers is_free) {
  using enum SensorNumbers::Index;
  for (const std::size_t i : {kX, kY, kZ, kRange, kFactor}) is_free[i] = false;
  return is_free;
}

void AddSigmas(const NormalEquations& equations, const FreeNumbers& is_free, SensorFit* fit) {
  const Matrix covariance = OnlyFree(equations.information + PriorInformation(), is_free).inverse();
  Matrix scatter = Matrix::Zero();
  const auto scans = static_cast<double>(equations.score_of_scan.size());
  for (const auto& [scan, score] : equations.score_of_scan) {
    const Vector centred = score - equations.score / scans;
    scatter += centred * centred.transpose();
  }
  const Matrix sandwich = covariance * OnlyFree(scatter, is_free) * covariance;
  for (std::size_t i = 0; i < SensorNumbers::kCount; ++i) {
    if (!is_free[i]) continue;
    const auto k = static_cast<Eigen::Index>(i);
    fit->undetermined[i] = std::sqrt(covariance(k, k)) / kPrior[i];
    double variance = covariance(k, k);
    if (equations.score_of_scan.size() >= kFewestScans) {
      variance = std::max(variance, sandwich(k, k));
    }
    fit->sigma[i] = std::sqrt(variance);
  }
}

}  // namespace

SensorFit FitSensor(const SensorComparison& sensor, const std::vector<ScanPoints>& points,
                    const FreeNumbers& is_free, const SensorNumbers& start, double scale) {
  SensorFit fit{start, {}, {}};
  for (int coarse = sensor.coarsest; coarse > 0; --coarse) {
    for (int round = 0; round < kCoarseRounds; ++round) {
      const auto residuals = sensor.residuals(points, fit.numbers, coarse);
      const double wide = std::max(scale, kWide * ScaleOf(residuals));
      Step(EquationsOf(residuals, wide), coarse > 2 ? TurningAlone(is_free) : is_free, start,
           &fit.numbers);
    }
  }
  double wide = 0;
  NormalEquations equations;
  for (int round = 0; round < kRounds; ++round) {
    const auto residuals = sensor.residuals(points, fit.numbers, 0);
    if (round == 0) wide = std::max(scale, kWide * ScaleOf(residuals));
    const double now = std::max(scale, wide * std::pow(kNarrowing, round));
    equations = EquationsOf(residuals, now);
    const double length = Step(equations, is_free, start, &fit.numbers);
    if (now <= scale && length < kStill) break;
  }
  AddSigmas(equations, is_free, &fit);
  return fit;
}

double LogDensityAt(double distance_over_sigma) {
  const double x = std::min(std::abs(distance_over_sigma), kFurthest);
  return -0.5 * (kDof + 1) * std::log1p(x * x / kDof);
}

double LogLikelihoodOf(const PointResidual& residual, double scale) {
  if (!residual.is_judged()) return LogDensityAt(kFurthest);
  return LogDensityAt(residual.beyond / (scale * residual.sigma));
}

double ScaleOf(const std::vector<PointResidual>& residuals) {
  std::vector<double> distances;
  for (const PointResidual& r : residuals) {
    if (r.is_judged()) distances.push_back(std::abs(r.beyond / r.sigma));
  }
  if (distances.empty()) return 1;
  constexpr double kMadToSigma = 1.4826;
  return std::max(kLeastScale, kMadToSigma * Median(std::move(distances)));
}

}  // namespace tera
