#pragma once

#include <vector>

#include "diagnose/search/fit/structure_fit.h"
#include "diagnose/search/structure/pruning.h"
#include "diagnose/search/structure/search_result.h"

namespace tera {

/// Compares a structure with its rivals: structures in which another candidate replaces one of its
/// terms.
///
/// Model   a rival is rejected if replacing it by the term gives a gain on cross-fitted manoeuvres
///         of TRAIN and SELECT: p is at most kRivalP and the gain at least kRivalGain. The
///         comparison is repeated with one more mechanism in both structures: the likeliest timing
///         or actuator mechanism within tolerance (expected_beside.h). The rival must be rejected
///         in both.
class RivalTests {
 public:
  /// All arguments must outlive this object.
  RivalTests(const ReplayBlock& block, const StructureFitter& fitter, const Pruning& pruning)
      : block_(block), fitter_(fitter), pruning_(pruning) {}

  /// Each structure of `swapped` ends with the candidate that replaces the term. Adds that
  /// candidate to the term's rivals or to its rejected rivals. `crossed` is the cross-fitted misfit
  /// of `found`.
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
