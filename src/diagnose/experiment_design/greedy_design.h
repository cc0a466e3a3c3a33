#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/search/block/block_diagnosis.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/noise_model.h"

namespace tera {

/// Two hypotheses on one block. An experiment should be able to accept `truth` and reject
/// `alternative`.
struct RivalPair {
  Structure truth, alternative;
};

/// Hypotheses on one block that a recording cannot discriminate.
struct AmbiguitySet {
  std::vector<std::string> members;  ///< mechanisms; "nothing" for no effect
  bool is_class = false;  ///< true: a finding and its rivals; false: an undetectable mechanism
  std::vector<RivalPair> pairs;
};

/// Ambiguity sets that a diagnosis leaves for a block. The class of each finding with rivals is a
/// set; its pairs are every member against every other, and against no effect. Each undetectable
/// mechanism is a set. Its pair compares all findings plus the mechanism, at a middle starting
/// value, with the findings alone. Members of a class are fitted to TRAIN and SELECT. The terms
/// point to the block's candidates.
std::vector<AmbiguitySet> AmbiguitySetsOf(const ReplayBlock& block,
                                          const BlockDiagnosis& diagnosis);

/// Probability that a diagnosis of `run` identifies the true hypothesis of a set: the minimum over
/// the set's pairs. Returns 0 if the run has too few manoeuvres for a diagnosis.
///
/// Model   The prediction of the true hypothesis replaces the measurements. The alternative is
///         fitted to it over TRAIN and SELECT. A class uses the tests of rivals
///         (structure_search.h). A mechanism uses the tests of selection at `level` and of
///         confirmation (block_diagnosis.h). The tests run on 100 random draws of the gain in
///         log-likelihood. The gain of each piece is normal; its mean is the possible gain, and its
///         variance is twice the mean.
/// Omits   The estimate of the noise within a diagnosis.
double DiscriminationPower(const AmbiguitySet& set, const ReplayBlock& run, const NoiseModel& noise,
                           double level, const Stream& stream);

/// Information of one excitation on a rival pair. The normal equations fit the alternative's
/// parameters and nuisances to the difference between both predictions.
struct PairInformation {
  Eigen::MatrixXd information;
  Eigen::VectorXd pull;
  double energy = 0;  ///< squared norm of the whitened difference

  PairInformation& operator+=(const PairInformation& other);
  /// Log-likelihood by which the true hypothesis exceeds the best fit of the alternative: half of
  /// the energy that the alternative's parameters cannot explain.
  double Lead() const;
};

/// Information of the excitations of one run, pairs x excitations.
///
/// Model   Both hypotheses predict the run. Predictions of the alternative are linear in its
///         parameters, by secants over a fiftieth of their ranges. The parameters have normal
///         priors about their values, with a standard deviation of 0.3 of the range. Nuisances are
///         those of likelihood.h. The noise is Gaussian, by the block's noise model.
/// Omits   Nonlinearity over larger parameter changes; the tails of the noise.
/// Source  Atkinson and Fedorov 1975, "The design of experiments for discriminating between two
///         rival models" (the lead is their T-criterion).
std::vector<std::vector<PairInformation>> InformationOf(const ReplayBlock& run,
                                                        const NoiseModel& noise,
                                                        const std::vector<RivalPair>& pairs,
                                                        const std::vector<Segment>& excitations);

/// Indices of the excitations to drive, in order and with repetitions, within `duration_s`. The
/// choice is greedy: each step adds the excitation with the greatest gain per second. The gain is
/// that of the sum over pairs of weight times log(1 + lead).
std::vector<std::size_t> ChooseExcitations(
    const std::vector<std::vector<PairInformation>>& information, const std::vector<double>& weight,
    const std::vector<double>& length_s, double duration_s);

}  // namespace tera
