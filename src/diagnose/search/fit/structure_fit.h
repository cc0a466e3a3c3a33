#pragma once

#include <optional>
#include <vector>

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// A structure with the numbers that make the measurements most likely.
struct FittedStructure {
  Structure terms;
  double log_likelihood = 0;    ///< on the samples that it was fitted to, nuisances penalised
  Misfit misfit;                ///< nuisances from the same samples
  Eigen::MatrixXd information;  ///< of the free parameters, in the order of terms and their `free`
  Eigen::MatrixXd scores;       ///< of the same by the manoeuvres fitted to, one column each
};

/// The default of a parameter: the model's present number, or the mechanism's own; none where it
/// must be given.
std::optional<double> DefaultOf(const Candidate& candidate, std::size_t index);
/// A free parameter as a place in its range, 0 to 1.
double PlaceOf(const FreeParameter& free, double value);
/// The free parameter at a place in its range.
double ValueAt(const FreeParameter& free, double place);

/// How far a fit goes: to convergence, or a few steps, which tell which of many structures are
/// worth more and are enough where the numbers are nearly right.
enum class Effort { kFull, kFewSteps };

/// Fits the free parameters of a structure.
///
/// Model   maximum likelihood within the parameters' bounds by Levenberg–Marquardt on signed square
///         roots of the Student-t deviance, difference quotients of a five-hundredth of each
///         range, or of half the distance of its likelihood's kinks; numbers that have kinks are
///         then moved by themselves, by that distance and steps that are halved; nuisances are
///         fitted anew in every evaluation. Starts: the values of `terms` as given, and with the
///         last term's replaced by each start of its candidate; the most likely one is refined.
///         Where the empty structure fits badly (innovations of more than twice the noise's
///         variance), a second fit first goes under white noise of the size of that misfit, whose
///         likelihood is smooth far from the truth, and from there under the noise itself; the
///         likelier of both fits counts.
/// Source  Ceres Solver (trust region with bounds); Golub and Pereyra 1973 (variable projection).
class StructureFitter {
 public:
  /// Fits to the samples that the likelihood is of, all in `manoeuvres`, in order, by which scores
  /// are given. Block and likelihood must outlive it.
  StructureFitter(const ReplayBlock& block, const Likelihood& likelihood,
                  std::vector<Segment> manoeuvres, int threads = 1);

  /// The fitted values alone, without information, scores and held numbers.
  FittedStructure FitValues(const Structure& terms, Effort effort = Effort::kFull) const;
  /// The likeliest fit from several structures, each refined by a few steps; there must be one.
  FittedStructure FitLikeliest(const std::vector<Structure>& starts) const;
  /// FitValues without the smooth likelihood: for structures whose other terms are fitted
  /// already.
  FittedStructure FitNear(const Structure& terms, Effort effort = Effort::kFull) const;
  /// FitValues from the given values alone.
  FittedStructure FitFrom(const Structure& terms, Effort effort = Effort::kFull) const;
  /// Adds information and scores to fitted values. Numbers that the measurements do not determine
  /// (a direction of the information that is not known to within the parameters' ranges) are held
  /// at their defaults, and the others fitted anew; of numbers without defaults one of which
  /// nothing is stated is held where it is.
  FittedStructure Determine(FittedStructure fitted) const;
  /// The structure with the values given, evaluated without a fit.
  FittedStructure AsGiven(Structure terms) const;

 private:
  /// A start of a fit, and the prediction there.
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
