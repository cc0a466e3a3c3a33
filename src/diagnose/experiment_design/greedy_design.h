#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnose/experiment_design/ambiguity_set.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

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
