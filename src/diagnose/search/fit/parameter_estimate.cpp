#include "diagnose/search/fit/parameter_estimate.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// A direction with a smaller ratio to the largest eigenvalue of the information is undetermined.
constexpr double kLeastEigenvalueRatio = 1e-10;
/// Share of its range within which an estimate is at the bound.
constexpr double kBoundDistance = 1e-3;
/// Relative standard deviation of a mechanism's parameter, by errors of nominal numbers and of the
/// mechanism's form.
constexpr double kFormSigma = 0.05;

/// Inverse of an information matrix, and which parameters it determines.
struct Covariance {
  Eigen::MatrixXd matrix;
  std::vector<bool> is_determined;
};

Covariance CovarianceOf(const Eigen::MatrixXd& information) {
  const Eigen::Index size = information.rows();
  if (size == 0) return {};
  const Eigen::VectorXd unit = information.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const Eigen::MatrixXd scaled =
      unit.cwiseInverse().asDiagonal() * information * unit.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  const double least = kLeastEigenvalueRatio * solver.eigenvalues().maxCoeff();
  Covariance out{Eigen::MatrixXd::Zero(size, size), {}};
  for (Eigen::Index i = 0; i < size; ++i) out.is_determined.push_back(information(i, i) > 0);
  for (Eigen::Index e = 0; e < size; ++e) {
    const Eigen::VectorXd direction = solver.eigenvectors().col(e);
    if (solver.eigenvalues()[e] > least) {
      out.matrix += direction * direction.transpose() / solver.eigenvalues()[e];
      continue;
    }
    for (Eigen::Index i = 0; i < size; ++i) {
      if (direction[i] * direction[i] > 1e-6)
        out.is_determined[static_cast<std::size_t>(i)] = false;
    }
  }
  out.matrix = unit.cwiseInverse().asDiagonal() * out.matrix * unit.cwiseInverse().asDiagonal();
  return out;
}

/// Standard deviations of the free parameters: the larger of that for independent samples and that
/// by the scatter of scores over manoeuvres. None in the null space of the information.
/// Source  Huber 1967, White 1982 (scores).
std::vector<std::optional<double>> SigmasOf(const FittedStructure& fitted) {
  const Covariance covariance = CovarianceOf(fitted.information);
  const auto manoeuvres = static_cast<double>(fitted.scores.cols());
  const Eigen::MatrixXd moved = covariance.matrix * fitted.scores;
  const Eigen::VectorXd of_manoeuvres =
      manoeuvres / std::max(1.0, manoeuvres - 1) * moved.rowwise().squaredNorm();
  std::vector<std::optional<double>> sigma(covariance.is_determined.size());
  for (std::size_t i = 0; i < sigma.size(); ++i) {
    const auto p = static_cast<Eigen::Index>(i);
    if (!covariance.is_determined[i]) continue;
    sigma[i] = std::sqrt(std::max(covariance.matrix(p, p), of_manoeuvres[p]));
  }
  return sigma;
}

bool IsAtBound(const FreeParameter& free, double value) {
  const double place = PlaceOf(free, value);
  return place < kBoundDistance || place > 1 - kBoundDistance;
}

/// Standard deviation of a parameter or of its effect, by errors of the mechanism's form. 0 for
/// sensors, whose forms are exact.
double FormDeviation(const Mechanism& mechanism, double value) {
  return mechanism.slot < Slot::kSensorGeometry ? kFormSigma * std::abs(value) : 0;
}

/// Unit of a prismatic joint's parameter: rad reads as m, and N m as N.
std::string UnitOfSliding(std::string_view unit) {
  if (unit == "rad") return "m";
  if (unit == "rad/s") return "m/s";
  if (unit == "rad/s2") return "m/s2";
  if (unit == "N m") return "N";
  if (unit == "N m s/rad") return "N s/m";
  return std::string(unit);
}

}  // namespace

std::vector<ParameterEstimate> EstimatesOf(const FittedStructure& found, std::size_t wanted,
                                           bool slides) {
  const std::vector<std::optional<double>> sigmas = SigmasOf(found);
  std::size_t first = 0;
  for (std::size_t t = 0; t < wanted; ++t) first += found.terms[t].Free().size();
  const Term& term = found.terms[wanted];
  std::vector<ParameterEstimate> estimates;
  const auto& parameters = term.candidate->mechanism->parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::string_view unit = parameters[i].unit;
    estimates.push_back({std::string(parameters[i].name),
                         slides ? UnitOfSliding(unit) : std::string(unit),
                         term.values[i],
                         {}});
  }
  const std::vector<FreeParameter> moved = term.Free();
  for (std::size_t f = 0; f < moved.size(); ++f) {
    const FreeParameter& free = moved[f];
    if (sigmas[first + f].value_or(1e300) > free.upper - free.lower) continue;
    if (IsAtBound(free, term.values[free.index])) continue;
    const double value = term.values[free.index];
    const double effect = value - (free.expected ? free.expected->neutral : 0);
    const auto with_form = [&](double of) {
      return std::hypot(*sigmas[first + f], FormDeviation(*term.candidate->mechanism, of));
    };
    estimates[free.index].sigma = with_form(value);
    estimates[free.index].effect_sigma = with_form(effect);
  }
  return estimates;
}

}  // namespace tera
