#include "diagnose/perception/sensor_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/units.h"
#include "diagnose/statistics/robust.h"

namespace tera {
namespace {

using Vector = Eigen::Matrix<double, SensorNumbers::kCount, 1>;
using Matrix = Eigen::Matrix<double, SensorNumbers::kCount, SensorNumbers::kCount>;

constexpr double kAngle_rad = 0.02 * kDeg, kSurface_m = 0.002;
constexpr double kDof = 4;
constexpr double kFurthest = 30;  ///< sigmas: a point further away is no further evidence
constexpr int kRounds = 9;
constexpr double kNarrowing = 0.4;       ///< of the scale, from one round to the next
constexpr double kStill = 1e-3;          ///< of the prior: a step so short ends the rounds
constexpr double kTurn_rad = 1e-6;       ///< for derivatives of a rotation
constexpr double kLargestStep = 1;       ///< of the prior's standard deviation
constexpr double kLeastScale = 0.2;      ///< noise cannot be far below the model's
constexpr std::size_t kFewestScans = 5;  ///< for a scatter

const std::array<double, SensorNumbers::kCount> kPrior = {0.3,      0.3, 0.3,  5 * kDeg, 5 * kDeg,
                                                          5 * kDeg, 0.3, 0.05, 1};

/// Derivatives of beyond_m at one hit.
Vector SlopeOf(const RangeSource& source, const SensorNumbers& numbers, const RangePoint& point,
               const SimulatedReturn& hit) {
  const Vec3 p_T_m = TruePoint(source, numbers, point.p_S_m);
  const Mat3 R_WB = hit.X_WB.linear();
  const Vec3 n_B = R_WB.transpose() * hit.normal_W;
  const Vec3 n_S = source.X_BS.linear().transpose() * n_B;
  const Vec3 n_T = numbers.R_ST().transpose() * n_S;
  Vector slope;
  slope.head<3>() = -n_B;
  for (int a = 0; a < 3; ++a) {
    SensorNumbers turned = numbers;
    turned.value[static_cast<std::size_t>(SensorNumbers::kRoll + a)] += kTurn_rad;
    slope[SensorNumbers::kRoll + a] =
        -n_S.dot((turned.R_ST() - numbers.R_ST()) * p_T_m) / kTurn_rad;
  }
  const double reported_m = source.planar_depth ? point.p_S_m.x() : point.p_S_m.norm();
  const double along = -n_T.dot(point.p_S_m) / reported_m;
  const double factor = numbers.value[SensorNumbers::kFactor];
  slope[SensorNumbers::kRange] = -along / factor;
  slope[SensorNumbers::kFactor] =
      -along * (reported_m - numbers.value[SensorNumbers::kRange]) / (factor * factor);
  // What moves with the machine tells little of time.
  slope[SensorNumbers::kOffset] = 0;
  if (hit.surface != Surface::kMachine) {
    const Vec3 p_W_m = PointInWorld(source, numbers, point, hit);
    const Vec3 v_W_mps = hit.v_WB_mps + hit.w_WB_radps.cross(p_W_m - hit.X_WB.translation());
    slope[SensorNumbers::kOffset] = hit.normal_W.dot(v_W_mps);
  }
  return slope;
}

double SigmaOf(const RangeSource& source, const SensorNumbers& numbers, const RangePoint& point,
               const SimulatedReturn& hit) {
  const Vec3 d_W =
      hit.X_WB.linear() * (source.X_BS.linear() * (numbers.R_ST() * point.p_S_m.normalized()));
  const double along = point.sigma_m * hit.normal_W.dot(d_W);
  const double across = kAngle_rad * point.p_S_m.norm();
  return std::sqrt(along * along + across * across + kSurface_m * kSurface_m);
}

double WeightOf(const PointResidual& residual, double scale) {
  const double x = residual.beyond_m / (scale * residual.sigma_m);
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
    const double over = WeightOf(r, scale) / std::pow(scale * r.sigma_m, 2);
    equations.information.selfadjointView<Eigen::Lower>().rankUpdate(r.slope, over);
    const Vector score = -over * r.beyond_m * r.slope;
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

std::vector<PointResidual> ResidualsOf(const RangeSource& source,
                                       const std::vector<ScanPoints>& points,
                                       const SensorNumbers& numbers) {
  std::vector<PointResidual> residuals;
  for (const ScanPoints& of_scan : points) {
    const RangeScan& scan = source.scans[of_scan.scan];
    std::vector<Beam> beams;
    for (const std::size_t p : of_scan.points) beams.push_back(BeamOf(scan.points[p]));
    const std::vector<SimulatedReturn> hits = source.cast(of_scan.scan, numbers, beams);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const RangePoint& point = scan.points[of_scan.points[i]];
      PointResidual residual;
      residual.scan = of_scan.scan;
      residual.surface = hits[i].surface;
      if (residual.is_judged()) {
        residual.beyond_m = BeyondSurface_m(source, numbers, point, hits[i]);
        residual.sigma_m = SigmaOf(source, numbers, point, hits[i]);
        residual.slope = SlopeOf(source, numbers, point, hits[i]);
      }
      residuals.push_back(residual);
    }
  }
  return residuals;
}

SensorFit FitSensor(const RangeSource& source, const std::vector<ScanPoints>& points,
                    const FreeNumbers& is_free, const SensorNumbers& start, double scale) {
  SensorFit fit{start, {}, {}};
  const Matrix prior = PriorInformation();
  double wide = 0;
  NormalEquations equations;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<PointResidual> residuals = ResidualsOf(source, points, fit.numbers);
    if (round == 0) wide = std::max(scale, 2 * ScaleOf(residuals));
    const double now = std::max(scale, wide * std::pow(kNarrowing, round));
    equations = EquationsOf(residuals, now);
    Vector away;
    for (std::size_t i = 0; i < SensorNumbers::kCount; ++i) {
      away[static_cast<Eigen::Index>(i)] = fit.numbers.value[i] - start.value[i];
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
      fit.numbers.value[i] += shorten * step[static_cast<Eigen::Index>(i)];
    }
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
  return LogDensityAt(residual.beyond_m / (scale * residual.sigma_m));
}

double ScaleOf(const std::vector<PointResidual>& residuals) {
  std::vector<double> distances;
  for (const PointResidual& r : residuals) {
    if (r.is_judged()) distances.push_back(std::abs(r.beyond_m / r.sigma_m));
  }
  if (distances.empty()) return 1;
  constexpr double kMadToSigma = 1.4826;
  return std::max(kLeastScale, kMadToSigma * Median(std::move(distances)));
}

}  // namespace tera
