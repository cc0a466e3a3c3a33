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

/// The number that a parameter has where its mechanism is not looked for; none where it must be
/// given.
std::optional<double> DefaultOf(const Candidate& candidate, std::size_t index);
/// A free parameter as a place in its range, 0 to 1.
double PlaceOf(const FreeParameter& free, double value);
/// The free parameter at a place in its range.
double ValueAt(const FreeParameter& free, double place);

/// How far a fit goes: to the end, or a few steps, to tell which of many are worth more, or where
/// the numbers are nearly right.
enum class Effort { kFull, kFewSteps };

/// Fits the free parameters of a structure.
///
/// Model   maximum likelihood within the parameters' bounds by Levenberg–Marquardt on signed square
///         roots of the Student-t deviance, difference quotients of a five-hundredth of each
///         range, or of half the distance of its likelihood's kinks; numbers that have kinks are
///         then moved by themselves, by that distance and steps that are halved; nuisances are
///         fitted anew in every evaluation. Starts: the values of `terms` as given, and with the
///         last term's replaced by each of its candidate's; the most likely one is refined. Where
///         nothing at all fits badly (innovations of more than twice the noise's variance),
///         likewise under white noise of the size of what nothing leaves, whose likelihood is
///         smooth far from the truth, and from there under the noise itself; the likelier of both
///         ends counts.
/// Source  Ceres Solver (trust region with bounds); Golub and Pereyra 1973 (variable projection).
class StructureFitter {
 public:
  /// Fits to the samples that the likelihood is of, all in `manoeuvres`, in order, by which scores
  /// are given. Block and likelihood must outlive it.
  StructureFitter(const ReplayBlock& block, const Likelihood& likelihood,
                  std::vector<Segment> manoeuvres, int threads = 1);

  /// Numbers that the measurements do not determine, a direction of the information that is not
  /// known to within the parameters' ranges, stand at their defaults and are held there.
  FittedStructure Fit(const Structure& terms) const;
  /// The same of a structure whose values are fitted already.
  FittedStructure Determine(FittedStructure fitted) const;
  /// Without information, scores and such numbers.
  FittedStructure FitValues(const Structure& terms, Effort effort = Effort::kFull) const;
  /// The same without the smooth likelihood: where the other terms are fitted already.
  FittedStructure FitNear(const Structure& terms, Effort effort = Effort::kFull) const;
  /// The same from the values given alone.
  FittedStructure FitFrom(const Structure& terms, Effort effort = Effort::kFull) const;
  /// Judged as it stands.
  FittedStructure AsGiven(Structure terms) const;

 private:
  /// Where a fit may begin, and what is predicted there.
  struct Start {
    Structure terms;
    std::vector<std::vector<double>> predicted;
  };

  std::vector<Start> StartsOf(const Structure& terms) const;
  Structure BestOf(const std::vector<Start>& starts, const Likelihood& likelihood) const;
  Structure Refine(const Structure& terms, const Likelihood& likelihood, Effort effort) const;
  Structure RefineSmooth(const Structure& terms, const Likelihood& likelihood,
                         int most_iterations) const;
  Structure Settle(Structure terms, const Likelihood& likelihood) const;
  void AddInformation(FittedStructure* fitted) const;

  const ReplayBlock& block_;
  const Likelihood& likelihood_;
  std::vector<Segment> manoeuvres_;
  int threads_;
  std::optional<Likelihood> coarse_;
};

}  // namespace tera
