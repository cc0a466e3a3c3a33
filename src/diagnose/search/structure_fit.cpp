#include "diagnose/search/structure_fit.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace tera {
namespace {

constexpr double kStep = 0.002;  ///< of a parameter's range, for difference quotients
constexpr int kMostIterations = 12;
constexpr double kBadFit = 2;  ///< mean squared innovation

/// A free parameter as a place in its range, 0 to 1.
double PlaceOf(const FreeParameter& free, double value) {
  const double place = free.logarithmic
                           ? std::log(value / free.lower) / std::log(free.upper / free.lower)
                           : (value - free.lower) / (free.upper - free.lower);
  return std::clamp(place, 0.0, 1.0);
}

double ValueAt(const FreeParameter& free, double place) {
  return free.logarithmic ? free.lower * std::pow(free.upper / free.lower, place)
                          : std::lerp(free.lower, free.upper, place);
}

std::vector<double> PlacesOf(const Structure& terms) {
  std::vector<double> places;
  for (const Term& term : terms) {
    for (const FreeParameter& free : term.suspect->free) {
      places.push_back(PlaceOf(free, term.values[free.index]));
    }
  }
  return places;
}

Structure AtPlaces(Structure terms, const double* places) {
  for (Term& term : terms) {
    for (const FreeParameter& free : term.suspect->free) {
      term.values[free.index] = ValueAt(free, *places++);
    }
  }
  return terms;
}

/// Square roots of the deviance by rows, and nuisances, as least squares wants them.
std::vector<double> Rows(const Likelihood& likelihood, const Misfit& misfit, const Mask& mask) {
  std::vector<double> rows;
  for (std::size_t c = 0; c < misfit.innovation.size(); ++c) {
    const double dof = likelihood.noise()[c].dof;
    for (std::size_t k = 0; k < mask.size(); ++k) {
      if (!mask[k] || !likelihood.rows(c)[k]) continue;
      const double e = misfit.innovation[c][static_cast<Eigen::Index>(k)];
      rows.push_back(std::copysign(std::sqrt(-2 * LogDensityOf(e, dof)), e));
    }
    for (int i = 0; i < 3; ++i) rows.push_back(misfit.nuisances[c][i]);
  }
  return rows;
}

class Deviance final : public ceres::CostFunction {
 public:
  Deviance(const ReplayBlock& block, const Likelihood& likelihood, const Mask& mask,
           const Structure& terms)
      : block_(block), likelihood_(likelihood), mask_(mask), terms_(terms) {
    places_ = PlacesOf(terms);
    set_num_residuals(static_cast<int>(RowsAt(places_).size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(places_.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    std::vector<double> at(parameters[0], parameters[0] + places_.size());
    const std::vector<double> rows = RowsAt(at);
    std::copy(rows.begin(), rows.end(), residuals);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    for (std::size_t p = 0; p < at.size(); ++p) {
      const double here = at[p], step = here + kStep <= 1 ? kStep : -kStep;
      at[p] = here + step;
      const std::vector<double> moved = RowsAt(at);
      at[p] = here;
      for (std::size_t k = 0; k < rows.size(); ++k) {
        jacobians[0][k * at.size() + p] = (moved[k] - rows[k]) / step;
      }
    }
    return true;
  }

  std::vector<double> RowsAt(const std::vector<double>& places) const {
    const auto predicted = block_.predict(AtPlaces(terms_, places.data()));
    return Rows(likelihood_, likelihood_.Judge(predicted, mask_), mask_);
  }

 private:
  const ReplayBlock& block_;
  const Likelihood& likelihood_;
  const Mask& mask_;
  const Structure& terms_;
  std::vector<double> places_;
};

/// J' J in the parameters' own units.
Eigen::MatrixXd InformationAt(const Deviance& deviance, const Structure& terms,
                              const std::vector<double>& places) {
  const auto count = static_cast<Eigen::Index>(places.size());
  std::vector<double> rows(static_cast<std::size_t>(deviance.num_residuals()));
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(rows.size(),
                                                                                  count);
  const double* at[] = {places.data()};
  double* jacobians[] = {jacobian.data()};
  deviance.Evaluate(at, rows.data(), jacobians);
  Eigen::Index p = 0;
  for (const Term& term : terms) {
    for (const FreeParameter& free : term.suspect->free) {
      const double range = free.logarithmic
                               ? term.values[free.index] * std::log(free.upper / free.lower)
                               : free.upper - free.lower;
      jacobian.col(p++) /= range;
    }
  }
  return jacobian.transpose() * jacobian;
}

/// White noise of the size of what is left of each channel, if that is much more than the noise.
std::optional<Likelihood> CoarseLikelihood(const ReplayBlock& block, const Misfit& misfit) {
  std::vector<NoiseModel> noise;
  bool bad = false;
  for (std::size_t c = 0; c < block.channels.size(); ++c) {
    double innovations = 0, left = 0, count = 0;
    for (std::size_t k = 0; k < block.samples(); ++k) {
      if (!misfit.residual[c].valid[k]) continue;
      innovations += std::pow(misfit.innovation[c][static_cast<Eigen::Index>(k)], 2);
      left += std::pow(misfit.residual[c].value[k], 2);
      ++count;
    }
    bad = bad || innovations > kBadFit * count;
    noise.push_back({.scale = std::sqrt(left / std::max(count, 1.0)) + 1e-300, .dof = 10});
  }
  if (!bad) return std::nullopt;
  return Likelihood(block, noise);
}

}  // namespace

StructureFitter::StructureFitter(const ReplayBlock& block, const Likelihood& likelihood,
                                 Mask fit_on)
    : block_(block),
      likelihood_(likelihood),
      fit_on_(std::move(fit_on)),
      coarse_(CoarseLikelihood(block, likelihood.Judge(block.predict({}), fit_on_))) {}

FittedStructure StructureFitter::AsGiven(Structure terms) const {
  FittedStructure out;
  out.misfit = likelihood_.Judge(block_.predict(terms), fit_on_);
  out.log_likelihood = likelihood_.SumWithPenalty(out.misfit, fit_on_);
  out.terms = std::move(terms);
  return out;
}

Structure StructureFitter::BestStart(Structure terms, const Likelihood& likelihood) const {
  const auto log_likelihood = [&] {
    return likelihood.SumWithPenalty(likelihood.Judge(block_.predict(terms), fit_on_), fit_on_);
  };
  Structure best = terms;
  double most = log_likelihood();
  for (const std::vector<double>& start : terms.back().suspect->starts) {
    terms.back().values = start;
    const double this_one = log_likelihood();
    if (this_one <= most) continue;
    most = this_one;
    best = terms;
  }
  return best;
}

Structure StructureFitter::Refine(const Structure& terms, const Likelihood& likelihood) const {
  std::vector<double> places = PlacesOf(terms);
  if (places.empty()) return terms;
  const Deviance deviance(block_, likelihood, fit_on_, terms);
  ceres::Problem::Options keep;
  keep.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(keep);
  // Ceres wants to be given the function for keeps; it changes nothing in it.
  problem.AddResidualBlock(const_cast<Deviance*>(&deviance), nullptr, places.data());
  for (int p = 0; p < static_cast<int>(places.size()); ++p) {
    problem.SetParameterLowerBound(places.data(), p, 0);
    problem.SetParameterUpperBound(places.data(), p, 1);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kMostIterations;
  options.function_tolerance = 1e-7;
  options.parameter_tolerance = 1e-5;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return AtPlaces(terms, places.data());
}

FittedStructure StructureFitter::Fit(Structure terms) const {
  if (terms.empty()) return AsGiven(std::move(terms));
  FittedStructure out = AsGiven(Refine(BestStart(terms, likelihood_), likelihood_));
  if (coarse_) {
    const Structure rough = Refine(BestStart(terms, *coarse_), *coarse_);
    FittedStructure other = AsGiven(Refine(rough, likelihood_));
    if (other.log_likelihood > out.log_likelihood) out = std::move(other);
  }
  const Deviance deviance(block_, likelihood_, fit_on_, out.terms);
  out.information = InformationAt(deviance, out.terms, PlacesOf(out.terms));
  return out;
}

}  // namespace tera
