#pragma once

#include <vector>

#include "diagnose/search/fit/structure_fit.h"
#include "diagnose/search/structure/pruning.h"
#include "diagnose/search/structure/search_result.h"

namespace tera {

/// Tells a structure from those that have another candidate in place of one of its terms.
///
/// Model   a rival is rejected where the manoeuvres of TRAIN and SELECT, each left out of the fits
///         that it judges, gain from the term with p at most kRivalP and at least kRivalGain, and
///         do so as well with the likeliest mechanism of timing or actuator beside both that is as
///         expected (expected_beside.h).
class RivalTests {
 public:
  /// All must outlive it.
  RivalTests(const ReplayBlock& block, const StructureFitter& fitter, const Pruning& pruning)
      : block_(block), fitter_(fitter), pruning_(pruning) {}

  /// Adds the candidates that end the swapped structures to the rivals of the term that they stand
  /// for, or to those that are rejected. `crossed` is what the found structure leaves.
  void Discriminate(const Structure& found, const Misfit& crossed,
                    const std::vector<Structure>& swapped, TermEvidence* evidence) const;

 private:
  Rival CompareWith(const Structure& swapped, const Misfit& left, const Misfit& crossed) const;
  Rival CompareWithExpectedBeside(const Structure& found, const Structure& swapped,
                                  const Misfit& crossed) const;

  const ReplayBlock& block_;
  const StructureFitter& fitter_;
  const Pruning& pruning_;
};

}  // namespace tera
