#include "diagnose/perception/registration/registration_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "diagnose/search/fit/structure_fit.h"

namespace tera {
namespace {

constexpr int kFineRounds = 9, kCoarseRounds = 4;
/// Levels from this one up keep mount position and range errors fixed.
constexpr int kTurnsAlone = 3;
constexpr double kFirstScaleRatio = 2;  ///< initial scale over robust scale
constexpr double kNarrowing = 0.4;      ///< ratio of scales of consecutive rounds
constexpr double kConverged = 1e-3;  ///< longest step at convergence, in prior standard deviations
constexpr double kLargestStep = 1;   ///< longest step of an iteration, in prior standard deviations
constexpr std::size_t kFewestScans = 5;  ///< needed for a scatter of scores

struct TermParameter {
  std::size_t term;
  FreeParameter free;
};

std::vector<TermParameter> FreeOf(const Structure& terms) {
  std::vector<TermParameter> parameters;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    for (const FreeParameter& free : terms[t].Free()) parameters.push_back({t, free});
  }
  return parameters;
}

/// Normal equations of one round, for the elements of the calibration.
struct NormalEquations {
  CalibrationMatrix information = CalibrationMatrix::Zero();
  CalibrationVector score = CalibrationVector::Zero();
  std::map<std::size_t, CalibrationVector> score_of_scan;
};

NormalEquations EquationsOf(const std::vector<PointResidual>& residuals, double scale) {
  NormalEquations equations;
  for (const PointResidual& r : residuals) {
    if (!r.is_judged()) continue;
    const double weight = RobustWeightOf(r, scale) / std::pow(scale * r.sigma, 2);
    equations.information.selfadjointView<Eigen::Lower>().rankUpdate(r.by_calibration, weight);
    const CalibrationVector score = -weight * r.distance * r.by_calibration;
    equations.score += score;
    equations.score_of_scan.try_emplace(r.scan, CalibrationVector::Zero()).first->second += score;
  }
  equations.information = equations.information.selfadjointView<Eigen::Lower>();
  return equations;
}

Eigen::MatrixXd PriorInformation(const std::vector<TermParameter>& parameters) {
  Eigen::VectorXd diagonal(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    diagonal[static_cast<Eigen::Index>(p)] = std::pow(parameters[p].free.prior_sigma, -2);
  }
  return diagonal.asDiagonal();
}

/// True if a parameter changes only the sensor's rotation or clock.
bool TurnsAlone(const CalibrationVector& derivative) {
  return derivative.segment<3>(kShiftOfMount).isZero() && derivative[kRangeBias] == 0 &&
         derivative[kRangeFactor] == 0;
}

/// One Gauss-Newton step from the values of `terms`, with priors about `start`. Returns the step's
/// length before shortening, in prior standard deviations.
double Step(const NormalEquations& equations, CalibrationJacobian jacobian, bool turns_alone,
            const Structure& start, Structure* terms) {
  const std::vector<TermParameter> parameters = FreeOf(*terms);
  if (parameters.empty()) return 0;
  const Eigen::MatrixXd prior = PriorInformation(parameters);
  Eigen::VectorXd away(jacobian.cols());
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto& [term, free] = parameters[p];
    const auto column = static_cast<Eigen::Index>(p);
    away[column] = (*terms)[term].values[free.index] - start[term].values[free.index];
    if (!turns_alone || TurnsAlone(jacobian.col(column))) continue;
    // A zero derivative and a zero offset from the prior keep the parameter fixed.
    jacobian.col(column).setZero();
    away[column] = 0;
  }
  const Eigen::MatrixXd information =
      jacobian.transpose() * equations.information * jacobian + prior;
  const Eigen::VectorXd score = jacobian.transpose() * equations.score - prior * away;
  const Eigen::VectorXd step = information.ldlt().solve(score);
  double length = 0;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    length = std::max(
        length, std::abs(step[static_cast<Eigen::Index>(p)]) / parameters[p].free.prior_sigma);
  }
  const double shorten = length > kLargestStep ? kLargestStep / length : 1;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto& [term, free] = parameters[p];
    double& value = (*terms)[term].values[free.index];
    value =
        std::clamp(value + shorten * step[static_cast<Eigen::Index>(p)], free.lower, free.upper);
  }
  return length;
}

/// Sum over scans of the outer products of the centred scores.
CalibrationMatrix ScatterOf(const NormalEquations& equations) {
  CalibrationMatrix scatter = CalibrationMatrix::Zero();
  const auto scans = static_cast<double>(equations.score_of_scan.size());
  for (const auto& [scan, score] : equations.score_of_scan) {
    const CalibrationVector centred = score - equations.score / scans;
    scatter += centred * centred.transpose();
  }
  return scatter;
}

void SetPrecision(const NormalEquations& equations, const CalibrationJacobian& jacobian,
                  RegistrationFit* fit) {
  const std::vector<TermParameter> parameters = FreeOf(fit->terms);
  if (parameters.empty()) return;
  const Eigen::MatrixXd covariance =
      (jacobian.transpose() * equations.information * jacobian + PriorInformation(parameters))
          .inverse();
  const Eigen::MatrixXd sandwich =
      covariance * (jacobian.transpose() * ScatterOf(equations) * jacobian) * covariance;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto k = static_cast<Eigen::Index>(p);
    const auto& [term, free] = parameters[p];
    double variance = covariance(k, k);
    const double prior_share = std::sqrt(variance) / free.prior_sigma;
    if (equations.score_of_scan.size() >= kFewestScans) {
      variance = std::max(variance, sandwich(k, k));
    }
    fit->precision[term][free.index] = {std::sqrt(variance), prior_share};
  }
}

/// Fits all free parameters, including those that the points do not determine.
RegistrationFit FitAllFree(const RegistrationBlock& block, const std::vector<ScanPoints>& points,
                           const Structure& start, double scale) {
  RegistrationFit fit{start, {}};
  for (const Term& term : start) {
    fit.precision.emplace_back(term.candidate->mechanism->parameters.size());
  }
  const auto jacobian = [&] { return JacobianOf(block.X_BS, block.present, fit.terms); };
  for (int level = block.coarsest; level > 0; --level) {
    for (int round = 0; round < kCoarseRounds; ++round) {
      const auto residuals = block.residuals(points, block.Under(fit.terms), level);
      const double wide = std::max(scale, kFirstScaleRatio * ScaleOf(residuals));
      Step(EquationsOf(residuals, wide), jacobian(), level >= kTurnsAlone, start, &fit.terms);
    }
  }
  double wide = 0;
  NormalEquations equations;
  CalibrationJacobian derivatives;
  for (int round = 0; round < kFineRounds; ++round) {
    const auto residuals = block.residuals(points, block.Under(fit.terms), 0);
    if (round == 0) wide = std::max(scale, kFirstScaleRatio * ScaleOf(residuals));
    const double now = std::max(scale, wide * std::pow(kNarrowing, round));
    equations = EquationsOf(residuals, now);
    derivatives = jacobian();
    const double length = Step(equations, derivatives, false, start, &fit.terms);
    if (now <= scale && length < kConverged) break;
  }
  SetPrecision(equations, derivatives, &fit);
  return fit;
}

/// Value in the scenario, or the value at which the mechanism has no effect.
double ValueWithout(const Candidate& candidate, std::size_t index) {
  return DefaultOf(candidate, index).value_or(candidate.starts.front()[index]);
}

/// Resets and holds the parameters that a fit left undetermined.
Structure WithoutUndetermined(Structure start, const RegistrationFit& fit) {
  for (std::size_t t = 0; t < start.size(); ++t) {
    Term& term = start[t];
    for (const FreeParameter& free : term.Free()) {
      if (fit.precision[t][free.index].is_determined()) continue;
      term.held.push_back(free.index);
      term.values[free.index] = ValueWithout(*term.candidate, free.index);
    }
  }
  return start;
}

bool HoldsMore(const Structure& terms, const Structure& before) {
  for (std::size_t t = 0; t < terms.size(); ++t) {
    if (terms[t].held.size() > before[t].held.size()) return true;
  }
  return false;
}

}  // namespace

RegistrationFit FitRegistration(const RegistrationBlock& block,
                                const std::vector<ScanPoints>& points, const Structure& start,
                                double scale) {
  const RegistrationFit all = FitAllFree(block, points, start, scale);
  const Structure determined = WithoutUndetermined(start, all);
  if (!HoldsMore(determined, start)) return all;
  RegistrationFit fit = FitAllFree(block, points, determined, scale);
  for (std::size_t t = 0; t < start.size(); ++t) {
    for (std::size_t i = 0; i < fit.precision[t].size(); ++i) {
      ParameterPrecision& precision = fit.precision[t][i];
      precision.prior_share = std::max(precision.prior_share, all.precision[t][i].prior_share);
    }
  }
  return fit;
}

}  // namespace tera
