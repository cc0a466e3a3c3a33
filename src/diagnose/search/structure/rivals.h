#pragma once

#include <vector>

#include "diagnose/search/fit/structure_fit.h"
#include "diagnose/search/structure/pruning.h"
#include "diagnose/search/structure/search_result.h"

namespace tera {

/// Compares a structure with its rivals, in which another candidate replaces one of its terms.
///
/// Model   a rival is rejected if the manoeuvres of TRAIN and SELECT, cross-fitted, gain from the
///         term with p at most kRivalP and at least kRivalGain. The same must hold when the
///         likeliest timing or actuator mechanism within tolerance joins both structures
///         (expected_beside.h).
class RivalTests {
 public:
  /// All arguments must outlive it.
  RivalTests(const ReplayBlock& block, const StructureFitter& fitter, const Pruning& pruning)
      : block_(block), fitter_(fitter), pruning_(pruning) {}

  /// Each of the `swapped` structures ends with the candidate that replaces the term. Adds these
  /// candidates to the term's rivals or to its rejected ones. `crossed` is the cross-fitted misfit
  /// of the found structure.
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
