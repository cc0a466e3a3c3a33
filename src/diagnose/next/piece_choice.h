#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnose/next/open_question.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// What one piece of a run says of one question: the normal equations of what the false account
/// must do about the difference.
struct PieceEvidence {
  Eigen::MatrixXd information;
  Eigen::VectorXd pull;
  double energy = 0;  ///< of the whitened difference

  PieceEvidence& operator+=(const PieceEvidence& other);
  /// Log-likelihood by which the true account leads at the false one's best: what is left of the
  /// difference.
  double Lead() const;
};

/// The evidence of pieces of a run, questions x pieces.
///
/// Model   both accounts predict the run; the false one's numbers move in proportion to their
///         secants over a fiftieth of their ranges (normal about where they are, with three tenths
///         of the range), its nuisances as in likelihood.h; the noise is Gaussian, of the block's
///         model.
/// Omits   how numbers move further away; the tails.
std::vector<std::vector<PieceEvidence>> EvidenceOf(const ReplayBlock& run, const NoiseModel& noise,
                                                   const std::vector<OpenQuestion>& questions,
                                                   const std::vector<Segment>& pieces);

/// Which pieces to drive, each as often as it is named, in order: greedily the one that adds most
/// to the sum of log(1 + lead) over the questions, by `weight`, for each second.
std::vector<std::size_t> ChoosePieces(const std::vector<std::vector<PieceEvidence>>& evidence,
                                      const std::vector<double>& weight,
                                      const std::vector<double>& length_s, double duration_s);

}  // namespace tera
