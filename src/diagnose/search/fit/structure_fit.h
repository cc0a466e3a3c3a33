#pragma once

#include <optional>
#include <vector>

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

struct FittedStructure {
  Structure terms;
  /// Log-likelihood of the fitted samples, with the penalty of the nuisance parameters.
  double log_likelihood = 0;
  Misfit misfit;  ///< nuisance parameters fitted to the same samples
  /// Information of the free parameters, in the order of terms and their `free`.
  Eigen::MatrixXd information;
  Eigen::MatrixXd scores;  ///< rows as in `information`; one column per fitted manoeuvre
};

/// Default of a parameter: its value in the model, or else the default of the mechanism. Empty for
/// a parameter without a default.
std::optional<double> DefaultOf(const Candidate& candidate, std::size_t index);
/// Position of a value in the parameter's range, 0 to 1.
double PlaceOf(const FreeParameter& free, double value);
/// Inverse of PlaceOf.
double ValueAt(const FreeParameter& free, double place);

/// A fit runs to convergence or a few steps. Few steps suffice to rank structures, and for
/// parameters that are nearly right.
enum class Effort { kFull, kFewSteps };

/// Fits the free parameters of a structure.
///
/// Model   maximum likelihood within bounds, by Levenberg–Marquardt on signed square roots of the
///         Student-t deviance. Difference quotients use 1/500 of each range, or half the distance
///         of the likelihood's kinks. Parameters with kinks are then searched one by one, in steps
///         of that distance that are halved repeatedly. Every evaluation refits the nuisances.
///
///         Starts: the values of `terms`, and the same with the last term at each start of its
///         candidate. The likeliest start is refined. The empty structure fits badly if its
///         innovations have more than twice the variance of the noise. In that case, a second fit
///         begins under white noise of that misfit's size, whose likelihood is smooth far from the
///         truth. The likelier of both fits is returned.
/// Source  Ceres Solver (trust region with bounds); Golub and Pereyra 1973 (variable projection).
class StructureFitter {
 public:
  /// `manoeuvres` cover all fitted samples, in order. Each gives a column of the scores. Block and
  /// likelihood must outlive this object.
  StructureFitter(const ReplayBlock& block, const Likelihood& likelihood,
                  std::vector<Segment> manoeuvres, int threads = 1);

  /// Fitted values without information and scores; undetermined parameters are not held.
  FittedStructure FitValues(const Structure& terms, Effort effort = Effort::kFull) const;
  /// The likeliest fit of several structures (at least one), each refined by a few steps.
  FittedStructure FitLikeliest(const std::vector<Structure>& starts) const;
  /// FitValues without the second fit under white noise. For structures whose other terms are
  /// already fitted.
  FittedStructure FitNear(const Structure& terms, Effort effort = Effort::kFull) const;
  /// FitValues from the given values only.
  FittedStructure FitFrom(const Structure& terms, Effort effort = Effort::kFull) const;
  /// Adds information and scores to fitted values. A direction of the information is undetermined
  /// if its standard deviation exceeds the parameters' ranges. One of its parameters is then held
  /// at its default, and the others are refitted. Without a default, a parameter without a stated
  /// tolerance is held at its value.
  FittedStructure Determine(FittedStructure fitted) const;
  /// The structure with the given values, without a fit.
  FittedStructure AsGiven(Structure terms) const;

 private:
  /// Starting values of a fit, and their prediction.
  struct Start {
    Structure terms;
    std::vector<std::vector<double>> predicted;
  };

  std::vector<Start> StartsOf(const Structure& terms) const;
  Structure BestOf(const std::vector<Start>& starts, const Likelihood& likelihood) const;
  Structure Refine(const Structure& terms, const Likelihood& likelihood, Effort effort) const;
  Structure RefineSmooth(const Structure& terms, const Likelihood& likelihood,
                         int most_iterations) const;
  Structure SearchKinks(Structure terms, const Likelihood& likelihood) const;
  void AddInformation(FittedStructure* fitted) const;

  const ReplayBlock& block_;
  const Likelihood& likelihood_;
  std::vector<Segment> manoeuvres_;
  int threads_;
  std::optional<Likelihood> smooth_;
};

}  // namespace tera
