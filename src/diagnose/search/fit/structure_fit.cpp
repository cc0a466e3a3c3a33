#include "diagnose/search/fit/structure_fit.h"

#include <ceres/ceres.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/in_parallel.h"
#include "diagnose/search/fit/steady_gain.h"

namespace tera {
namespace {

/// Step of difference quotients, as a share of the parameter's range.
constexpr double kStep = 0.002;
/// Step of difference quotients over the distance of the likelihood's kinks.
constexpr double kStepOfKink = 0.5;
/// Finest step of the search over kinks, as a share of the parameter's range.
constexpr double kFinestStep = 0.002;
/// Largest number of moves of one parameter in the search over kinks.
constexpr int kMostMoves = 30;
constexpr int kMostIterations = 12;  ///< Levenberg-Marquardt iterations of a full fit
constexpr int kFewIterations = 3;    ///< Levenberg-Marquardt iterations of a fit of few steps
/// Mean squared innovation of the empty structure above which a second fit starts under white
/// noise.
constexpr double kBadFit = 2;
/// Smallest component of a held parameter in an undetermined unit direction.
constexpr double kLeastComponent = 0.3;
/// Gain in log-likelihood of the last step at convergence.
constexpr double kConvergedGain = 0.005;

std::vector<double> PlacesOf(const Structure& terms) {
  std::vector<double> places;
  for (const Term& term : terms) {
    for (const FreeParameter& free : term.Free()) {
      places.push_back(PlaceOf(free, term.values[free.index]));
    }
  }
  return places;
}

std::vector<double> StepsOf(const Structure& terms) {
  std::vector<double> steps;
  for (const Term& term : terms) {
    for (const FreeParameter& free : term.Free()) {
      steps.push_back(free.kink > 0 ? kStepOfKink * free.kink : kStep);
    }
  }
  return steps;
}

Structure AtPlaces(Structure terms, const double* places) {
  for (Term& term : terms) {
    for (const FreeParameter& free : term.Free()) {
      term.values[free.index] = ValueAt(free, *places++);
    }
  }
  return terms;
}

/// Signed square roots of the deviances as a function of the free parameters' positions in their
/// ranges.
class Deviance final : public ceres::CostFunction {
 public:
  Deviance(const ReplayBlock& block, const Likelihood& likelihood, const Structure& terms,
           int threads)
      : block_(block),
        likelihood_(likelihood),
        terms_(terms),
        threads_(threads),
        steps_(StepsOf(terms)),
        last_places_(PlacesOf(terms)),
        last_rows_(RowsAt(last_places_)) {
    for (const double row : last_rows_) cost_at_start_ += 0.5 * row * row;
    set_num_residuals(static_cast<int>(last_rows_.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(last_places_.size()));
  }

  /// Half the sum of squares at the starting terms.
  double cost_at_start() const { return cost_at_start_; }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const std::vector<double> at(parameters[0], parameters[0] + last_places_.size());
    if (at != last_places_) {  // the solver evaluates an accepted step twice
      last_rows_ = RowsAt(at);
      last_places_ = at;
    }
    const std::vector<double>& rows = last_rows_;
    std::copy(rows.begin(), rows.end(), residuals);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    const auto moved = InParallel<std::vector<double>>(at.size(), threads_, [&](std::size_t p) {
      std::vector<double> there = at;
      there[p] += StepFrom(at, p);
      return RowsAt(there);
    });
    for (std::size_t p = 0; p < at.size(); ++p) {
      const double step = StepFrom(at, p);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        jacobians[0][k * at.size() + p] = (moved[p][k] - rows[k]) / step;
      }
    }
    return true;
  }

  /// The step of the difference quotient; negative where it would leave the range at its upper end.
  double StepFrom(const std::vector<double>& at, std::size_t p) const {
    return at[p] + steps_[p] <= 1 ? steps_[p] : -steps_[p];
  }

  std::vector<double> RowsAt(const std::vector<double>& places) const {
    return likelihood_.Deviances(block_.predict(AtPlaces(terms_, places.data())));
  }

 private:
  const ReplayBlock& block_;
  const Likelihood& likelihood_;
  const Structure& terms_;
  const int threads_;
  const std::vector<double> steps_;
  /// Positions and rows of the last evaluation.
  mutable std::vector<double> last_places_, last_rows_;
  double cost_at_start_ = 0;
};

/// Derivative of each free parameter by its position in its range.
Eigen::VectorXd RangesAt(const Structure& terms) {
  std::vector<double> ranges;
  for (const Term& term : terms) {
    for (const FreeParameter& free : term.Free()) {
      ranges.push_back(free.logarithmic
                           ? term.values[free.index] * std::log(free.upper / free.lower)
                           : free.upper - free.lower);
    }
  }
  return Eigen::Map<const Eigen::VectorXd>(ranges.data(), static_cast<Eigen::Index>(ranges.size()));
}

/// A free parameter of a structure, by its term.
struct Freedom {
  Term* term = nullptr;
  std::size_t index = 0;
  double range = 1;
  bool is_stated = false;  ///< true if a tolerance is stated for it
};

std::vector<Freedom> FreedomsOf(Structure* terms) {
  const Eigen::VectorXd ranges = RangesAt(*terms);
  std::vector<Freedom> freedoms;
  for (Term& term : *terms) {
    for (const FreeParameter& free : term.Free()) {
      const auto place = static_cast<Eigen::Index>(freedoms.size());
      freedoms.push_back({&term, free.index, std::abs(ranges[place]), free.expected.has_value()});
    }
  }
  return freedoms;
}

/// Examines the least determined direction of the information. If its standard deviation exceeds
/// the parameters' ranges, the parameter with the largest component is held at its default. If none
/// has a default, one without a stated tolerance is held at its value. Returns true if one was
/// held.
bool HoldUndetermined(const Eigen::MatrixXd& information, Structure* terms) {
  const std::vector<Freedom> freedoms = FreedomsOf(terms);
  if (freedoms.empty()) return false;
  Eigen::VectorXd ranges(information.rows());
  for (Eigen::Index i = 0; i < ranges.size(); ++i) {
    ranges[i] = std::max(freedoms[static_cast<std::size_t>(i)].range, 1e-300);
  }
  const Eigen::MatrixXd scaled = ranges.asDiagonal() * information * ranges.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  if (!(solver.eigenvalues()[0] < 1)) return false;
  const Eigen::VectorXd direction = solver.eigenvectors().col(0);
  const auto largest_of = [&](const auto& may_be_held) {
    const Freedom* most = nullptr;
    double part = kLeastComponent;
    for (std::size_t i = 0; i < freedoms.size(); ++i) {
      const double own = std::abs(direction[static_cast<Eigen::Index>(i)]);
      if (own <= part || !may_be_held(freedoms[i])) continue;
      part = own;
      most = &freedoms[i];
    }
    return most;
  };
  const Freedom* most = largest_of(
      [](const Freedom& one) { return DefaultOf(*one.term->candidate, one.index).has_value(); });
  if (most == nullptr) most = largest_of([](const Freedom& one) { return !one.is_stated; });
  if (most == nullptr) return false;
  double& value = most->term->values[most->index];
  value = DefaultOf(*most->term->candidate, most->index).value_or(value);
  most->term->held.push_back(most->index);
  return true;
}

/// Likelihood under white noise with the size of the empty structure's misfit. None if that
/// structure fits well.
std::optional<Likelihood> SmoothLikelihood(const ReplayBlock& block, const Likelihood& likelihood) {
  const Misfit misfit = likelihood.Evaluate(block.predict({}));
  std::vector<NoiseModel> noise;
  Mask fitted(block.samples(), 0);
  bool bad = false;
  for (std::size_t c = 0; c < block.channels.size(); ++c) {
    double innovations = 0, left = 0;
    const std::vector<std::size_t>& samples = likelihood.fitted_samples(c);
    for (const std::size_t k : samples) {
      fitted[k] = 1;
      innovations += std::pow(misfit.innovation[c][static_cast<Eigen::Index>(k)], 2);
      left += std::pow(misfit.residual[c].value[k], 2);
    }
    const auto count = static_cast<double>(samples.size());
    bad = bad || innovations > kBadFit * count;
    noise.push_back({.scale = std::sqrt(left / std::max(count, 1.0)) + 1e-300, .dof = 10});
  }
  if (!bad) return std::nullopt;
  return Likelihood(block, noise, fitted);
}

}  // namespace

std::optional<double> DefaultOf(const Candidate& candidate, std::size_t index) {
  if (!candidate.present.empty()) return candidate.present[index];
  return candidate.mechanism->parameters[index].otherwise;
}

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

StructureFitter::StructureFitter(const ReplayBlock& block, const Likelihood& likelihood,
                                 std::vector<Segment> manoeuvres, int threads)
    : block_(block),
      likelihood_(likelihood),
      manoeuvres_(std::move(manoeuvres)),
      threads_(threads),
      smooth_(SmoothLikelihood(block, likelihood)) {}

FittedStructure StructureFitter::AsGiven(Structure terms) const {
  FittedStructure out;
  out.misfit = likelihood_.Evaluate(block_.predict(terms));
  out.log_likelihood = likelihood_.LogLikelihood(out.misfit);
  out.terms = std::move(terms);
  return out;
}

std::vector<StructureFitter::Start> StructureFitter::StartsOf(const Structure& terms) const {
  std::vector<std::vector<double>> values = terms.back().candidate->starts;
  if (std::find(values.begin(), values.end(), terms.back().values) == values.end()) {
    values.insert(values.begin(), terms.back().values);
  }
  return InParallel<Start>(values.size(), threads_, [&](std::size_t k) {
    Start start{terms, {}};
    start.terms.back().values = values[k];
    start.predicted = block_.predict(start.terms);
    return start;
  });
}

Structure StructureFitter::BestOf(const std::vector<Start>& starts,
                                  const Likelihood& likelihood) const {
  const std::vector<double> likely = InParallel<double>(
      starts.size(), threads_,
      [&](std::size_t k) { return likelihood.LogLikelihood(starts[k].predicted); });
  const auto best = std::max_element(likely.begin(), likely.end()) - likely.begin();
  return starts[static_cast<std::size_t>(best)].terms;
}

Structure StructureFitter::RefineSmooth(const Structure& terms, const Likelihood& likelihood,
                                        int most_iterations) const {
  std::vector<double> places = PlacesOf(terms);
  if (places.empty()) return terms;
  Deviance deviance(block_, likelihood, terms, threads_);
  ceres::Problem::Options keep;
  keep.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(keep);
  problem.AddResidualBlock(&deviance, nullptr, places.data());
  for (int p = 0; p < static_cast<int>(places.size()); ++p) {
    problem.SetParameterLowerBound(places.data(), p, 0);
    problem.SetParameterUpperBound(places.data(), p, 1);
  }
  ceres::Solver::Options options;
  options.num_threads = 1;  // Deviance itself evaluates in parallel
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = most_iterations;
  options.function_tolerance =
      std::min(1e-4, kConvergedGain / std::max(deviance.cost_at_start(), 1.0));
  options.parameter_tolerance = 1e-5;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return AtPlaces(terms, places.data());
}

/// Coordinate search over the parameters with kinks. Each moves by a step in either direction while
/// the likelihood rises, then by half the step.
Structure StructureFitter::SearchKinks(Structure terms, const Likelihood& likelihood) const {
  double most = likelihood.LogLikelihood(block_.predict(terms));
  for (std::size_t t = 0; t < terms.size(); ++t) {
    for (const FreeParameter& free : terms[t].Free()) {
      double step = free.kink;
      for (int move = 0; std::abs(step) > kFinestStep && move < kMostMoves; ++move) {
        Structure moved = terms;
        double& value = moved[t].values[free.index];
        value = ValueAt(free, std::clamp(PlaceOf(free, value) + step, 0.0, 1.0));
        const double this_one = likelihood.LogLikelihood(block_.predict(moved));
        if (this_one > most) {
          most = this_one;
          terms = std::move(moved);
        } else {
          step = step > 0 ? -step : -0.5 * step;
        }
      }
    }
  }
  return terms;
}

Structure StructureFitter::Refine(const Structure& terms, const Likelihood& likelihood,
                                  Effort effort) const {
  if (effort == Effort::kFewSteps) return RefineSmooth(terms, likelihood, kFewIterations);
  const Structure smooth = RefineSmooth(terms, likelihood, kMostIterations);
  const bool has_kinks = std::any_of(terms.begin(), terms.end(), [](const Term& term) {
    const std::vector<FreeParameter> free = term.Free();
    return std::any_of(free.begin(), free.end(), [](const FreeParameter& f) { return f.kink > 0; });
  });
  if (!has_kinks) return smooth;
  return RefineSmooth(SearchKinks(smooth, likelihood), likelihood, kMostIterations);
}

FittedStructure StructureFitter::FitValues(const Structure& terms, Effort effort) const {
  if (terms.empty()) return AsGiven(terms);
  const std::vector<Start> starts = StartsOf(terms);
  FittedStructure out = AsGiven(Refine(BestOf(starts, likelihood_), likelihood_, effort));
  if (smooth_) {
    const Structure rough = Refine(BestOf(starts, *smooth_), *smooth_, effort);
    FittedStructure other = AsGiven(Refine(rough, likelihood_, effort));
    if (other.log_likelihood > out.log_likelihood) out = std::move(other);
  }
  return out;
}

FittedStructure StructureFitter::FitLikeliest(const std::vector<Structure>& starts) const {
  const Likelihood& first = smooth_ ? *smooth_ : likelihood_;
  const auto near = InParallel<Start>(starts.size(), threads_, [&](std::size_t k) {
    Start start{Refine(starts[k], first, Effort::kFewSteps), {}};
    start.predicted = block_.predict(start.terms);
    return start;
  });
  Structure best = BestOf(near, first);
  if (smooth_) best = Refine(best, *smooth_, Effort::kFull);
  return AsGiven(Refine(best, likelihood_, Effort::kFull));
}

FittedStructure StructureFitter::FitNear(const Structure& terms, Effort effort) const {
  if (terms.empty()) return AsGiven(terms);
  return AsGiven(Refine(BestOf(StartsOf(terms), likelihood_), likelihood_, effort));
}

FittedStructure StructureFitter::FitFrom(const Structure& terms, Effort effort) const {
  return AsGiven(Refine(terms, likelihood_, effort));
}

FittedStructure StructureFitter::Determine(FittedStructure fitted) const {
  AddInformation(&fitted);
  while (HoldUndetermined(fitted.information, &fitted.terms)) {
    fitted = FitFrom(fitted.terms);
    AddInformation(&fitted);
  }
  return fitted;
}

/// Adds the information J' J, in the parameters' units, and the scores: J' times the rows of each
/// manoeuvre.
void StructureFitter::AddInformation(FittedStructure* fitted) const {
  std::vector<double> places = PlacesOf(fitted->terms);
  const auto count = static_cast<Eigen::Index>(places.size());
  fitted->information = Eigen::MatrixXd::Zero(count, count);
  fitted->scores = Eigen::MatrixXd::Zero(count, static_cast<Eigen::Index>(manoeuvres_.size()));
  if (count == 0) return;
  const Deviance deviance(block_, likelihood_, fitted->terms, threads_);
  std::vector<double> rows(static_cast<std::size_t>(deviance.num_residuals()));
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(rows.size(),
                                                                                  count);
  const double* at[] = {places.data()};
  double* jacobians[] = {jacobian.data()};
  deviance.Evaluate(at, rows.data(), jacobians);
  jacobian *= RangesAt(fitted->terms).cwiseInverse().asDiagonal();
  fitted->information = jacobian.transpose() * jacobian;
  std::size_t row = 0;
  for (std::size_t c = 0; c < block_.channels.size(); ++c) {
    std::size_t manoeuvre = 0;
    for (const std::size_t k : likelihood_.fitted_samples(c)) {
      while (k >= manoeuvres_[manoeuvre].end) ++manoeuvre;
      fitted->scores.col(static_cast<Eigen::Index>(manoeuvre)) +=
          rows[row] * jacobian.row(static_cast<Eigen::Index>(row)).transpose();
      ++row;
    }
    row += static_cast<std::size_t>(
        3 + block_.channels[c].nominal.cols());  // skip the rows of the nuisances
  }
}

}  // namespace tera
