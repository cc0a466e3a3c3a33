#pragma once

#include <optional>
#include <vector>

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// A structure with its most likely parameters.
struct FittedStructure {
  Structure terms;
  double log_likelihood = 0;    ///< on the fitted samples, with the penalty of nuisances
  Misfit misfit;                ///< with nuisances from the same samples
  Eigen::MatrixXd information;  ///< of the free parameters, in the order of terms and their `free`
  Eigen::MatrixXd scores;       ///< of the same parameters, a column for each fitted manoeuvre
};

/// Default of a parameter: the model's present value, or the mechanism's own. None if it must be
/// given.
std::optional<double> DefaultOf(const Candidate& candidate, std::size_t index);
/// A free parameter's relative position in its range, 0 to 1.
double PlaceOf(const FreeParameter& free, double value);
/// The inverse of PlaceOf.
double ValueAt(const FreeParameter& free, double place);

/// Effort of a fit: to convergence, or a few steps. These suffice to rank structures, and for
/// parameters that are nearly right.
enum class Effort { kFull, kFewSteps };

/// Fits the free parameters of a structure.
///
/// Model   maximum likelihood within the parameters' bounds, by Levenberg–Marquardt on signed
///         square roots of the Student-t deviance. Difference quotients use a five-hundredth of
///         each range, or half the distance of the likelihood's kinks. Parameters with kinks are
///         then searched individually, by that distance and successively halved steps. Every
///         evaluation fits the nuisances anew.
///         Starts: the values of `terms` as given, and with the last term's replaced by each start
///         of its candidate. The most likely one is refined. The empty structure fits badly if its
///         innovations have more than twice the noise's variance. A second fit then first uses
///         white noise of that misfit's size, whose likelihood is smooth far from the truth. The
///         likelier of both fits counts.
/// Source  Ceres Solver (trust region with bounds); Golub and Pereyra 1973 (variable projection).
class StructureFitter {
 public:
  /// Fits to the likelihood's samples, all of them in `manoeuvres`, in order, which also structure
  /// the scores. Block and likelihood must outlive it.
  StructureFitter(const ReplayBlock& block, const Likelihood& likelihood,
                  std::vector<Segment> manoeuvres, int threads = 1);

  /// Fitted values only, without information, scores and held parameters.
  FittedStructure FitValues(const Structure& terms, Effort effort = Effort::kFull) const;
  /// The likeliest fit of several structures, at least one, each refined by a few steps.
  FittedStructure FitLikeliest(const std::vector<Structure>& starts) const;
  /// FitValues without the smooth likelihood, for structures whose other terms are already fitted.
  FittedStructure FitNear(const Structure& terms, Effort effort = Effort::kFull) const;
  /// FitValues from the given values only.
  FittedStructure FitFrom(const Structure& terms, Effort effort = Effort::kFull) const;
  /// Adds information and scores to fitted values. A direction of the information is undetermined
  /// if its standard deviation exceeds the parameters' ranges. One of its parameters is then held
  /// at its default, and the others are fitted anew. Without a default, a parameter without a
  /// stated tolerance is held where it is.
  FittedStructure Determine(FittedStructure fitted) const;
  /// The structure with the given values, evaluated without a fit.
  FittedStructure AsGiven(Structure terms) const;

 private:
  /// Starting values of a fit and the prediction there.
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
