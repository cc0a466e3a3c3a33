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

/// Two hypotheses on one block. An experiment should show that the first is true and the second is
/// not.
struct RivalPair {
  Structure truth, alternative;
};

/// Hypotheses on one block that a recording does not discriminate.
struct AmbiguitySet {
  std::vector<std::string> members;  ///< identifiers; "nothing" for no effect
  bool is_class = false;             ///< class of a finding; else a mechanism that was not testable
  std::vector<RivalPair> pairs;
};

/// The ambiguity sets that a diagnosis leaves for a block. Each finding's class is one: every
/// member against every other, and against none. Each undetectable mechanism is one: half of its
/// largest size, added to all findings, against nothing. Members of a class are fitted to TRAIN and
/// SELECT. The terms point to the block's candidates.
std::vector<AmbiguitySet> AmbiguitySetsOf(const ReplayBlock& block,
                                          const BlockDiagnosis& diagnosis);

/// Probability that a diagnosis of a run identifies the true hypothesis of a set. It is the minimum
/// over the set's pairs, and 0 if the run has too few manoeuvres for a diagnosis.
///
/// Model   the true hypothesis's prediction replaces the measurements, and the alternative is
///         fitted to it over TRAIN and SELECT. A class uses the tests of rivals
///         (structure_search.h), a mechanism the test against nothing at `level`
///         (block_diagnosis.h). Each runs under 100 draws of the noise. A draw's gain in
///         log-likelihood is normal: its mean is the possible gain, its variance twice that.
/// Omits   the diagnosis's own estimate of the noise.
double DiscriminationPower(const AmbiguitySet& set, const ReplayBlock& run, const NoiseModel& noise,
                           double level, const Stream& stream);

/// Information of one excitation about a rival pair: the normal equations of the wrong hypothesis's
/// parameters and nuisances for the difference between both predictions.
struct PairInformation {
  Eigen::MatrixXd information;
  Eigen::VectorXd pull;
  double energy = 0;  ///< of the whitened difference

  PairInformation& operator+=(const PairInformation& other);
  /// Log-likelihood by which the true hypothesis leads the best fit of the wrong one: half of the
  /// energy that the wrong one's parameters cannot explain.
  double Lead() const;
};

/// The information in excitations of one run, pairs x excitations.
///
/// Model   both hypotheses predict the run. The wrong one's predictions are linear in its
///         parameters, by secants over a fiftieth of their ranges. The parameters are normal about
///         their values, with a standard deviation of three tenths of the range. Its nuisances are
///         those of likelihood.h. The noise is Gaussian, of the block's model.
/// Omits   nonlinearity over larger parameter changes; the tails of the noise.
/// Source  Atkinson and Fedorov 1975, "The design of experiments for discriminating between two
///         rival models" (the lead is their T-criterion).
std::vector<std::vector<PairInformation>> InformationOf(const ReplayBlock& run,
                                                        const NoiseModel& noise,
                                                        const std::vector<RivalPair>& pairs,
                                                        const std::vector<Segment>& excitations);

/// The excitations to drive, in order and with repetitions. Greedily adds the one with the greatest
/// gain per second in the sum of log(1 + lead) over the pairs, by `weight`.
std::vector<std::size_t> ChooseExcitations(
    const std::vector<std::vector<PairInformation>>& information, const std::vector<double>& weight,
    const std::vector<double>& length_s, double duration_s);

}  // namespace tera
