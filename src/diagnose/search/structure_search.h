#pragma once

#include <string>
#include <vector>

#include "diagnose/search/structure_fit.h"
#include "diagnose/statistics/manoeuvres.h"

namespace tera {

struct SearchOptions {
  std::size_t screened = 8;    ///< suspects that pairs are made of
  std::size_t deepest = 4;     ///< terms in a structure
  double alpha = 0.01;         ///< probability of a term where there is none, all suspects together
  double least_share = 0.02;   ///< of the excess, that a term must explain
  double least_effect = 0.02;  ///< RMS of what a term changes over the RMS of the channel
  double held_out_block_s = 0.25;
  int threads = 2;
};

/// How a term stands on samples that it was not fitted to.
struct TermEvidence {
  double p = 1;       ///< of a gain this steady over blocks by chance, times the number of suspects
  double share = 0;   ///< of the gain in likelihood that the free member has over nothing
  double effect = 0;  ///< RMS of what it changes over the RMS of the channel, largest over channels
  /// Suspects in whose place the structure is not significantly worse, itself first.
  std::vector<const Suspect*> rivals;
};

/// A suspect alone.
struct SingleEvidence {
  const Suspect* suspect = nullptr;
  std::vector<double> values;
  double gain = 0;           ///< of log-likelihood on TRAIN
  double held_out_gain = 0;  ///< on SELECT
};

struct SearchResult {
  FittedStructure nothing, found;
  std::vector<TermEvidence> evidence;  ///< one for each term found
  std::vector<SingleEvidence> singles;
  double free_gain = 0;  ///< held-out gain in log-likelihood of the free member over nothing
};

/// Which suspects explain a block, together.
///
/// Model   every suspect alone; every pair of the screened (the likeliest, and the likeliest of
///         each slot); then one term more at a time, with swaps, as long as the Bayesian
///         information criterion on TRAIN falls. Backward: a term goes unless its gain over the
///         structure refitted without it is significant on SELECT (signed ranks of the gains of
///         those short blocks in which the two predictions are discernible; Bonferroni over the
///         suspects), at least `least_share` of the excess, and its effect at least
///         `least_effect` of the channel. Rivals: each term is swapped for each screened
///         suspect.
/// Source  Wilcoxon 1945; Schwarz 1978.
SearchResult SearchStructures(const ReplayBlock& block, const Likelihood& likelihood,
                              const std::vector<Manoeuvre>& manoeuvres,
                              const SearchOptions& options);

/// Probability of gains of `after` over `before` as steady as these by chance: signed ranks over
/// the blocks in which the two differ by the noise's scale or more, which blocks does not hang on
/// the measurements.
double SteadyGainP(const Likelihood& likelihood, const Misfit& before, const Misfit& after,
                   const std::vector<Segment>& blocks);

/// Pieces of the samples of a part, each within one manoeuvre and about `block_s` long.
std::vector<Segment> HeldOutBlocks(const std::vector<Manoeuvre>& manoeuvres, Part part,
                                   double period_s, double block_s);

}  // namespace tera
