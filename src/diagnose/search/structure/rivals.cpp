#include "diagnose/search/structure/rivals.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/search/structure/expected_beside.h"

namespace tera {
namespace {

/// True if a swap explains the data within tolerances: the new term is within tolerance, and all
/// terms that were within tolerance stay there.
bool IsExpectedExchange(const Structure& found, const Structure& swapped) {
  return IsAsExpected(swapped.back()) &&
         std::none_of(swapped.begin(), swapped.end() - 1, [&](const Term& now) {
           return !IsAsExpected(now) &&
                  std::any_of(found.begin(), found.end(), [&](const Term& before) {
                    return before.candidate == now.candidate && IsAsExpected(before);
                  });
         });
}

bool HasSlot(const Structure& terms, Slot slot) {
  return std::any_of(terms.begin(), terms.end(),
                     [&](const Term& term) { return term.candidate->mechanism->slot == slot; });
}

bool IsRejected(const Rival& rival) { return rival.p <= kRivalP && rival.lead >= kRivalGain; }

}  // namespace

/// The rival at the end of `swapped`, with the gain of `crossed` over the swapped structure's
/// misfit `left`.
Rival RivalTests::CompareWith(const Structure& swapped, const Misfit& left,
                              const Misfit& crossed) const {
  const auto gains = pruning_.GainsOnSeen(left, crossed);
  Rival rival{swapped.back().candidate, SteadyGainP(gains), 0};
  for (const ManoeuvreGain& one : gains) rival.lead += one.gain;
  return rival;
}

/// CompareWith, with a timing or actuator mechanism within tolerance added to both structures: the
/// one that is likeliest with the rival. A rival must not lose merely because it lacks a deviation
/// that the machine may have anyway.
Rival RivalTests::CompareWithExpectedBeside(const Structure& found, const Structure& swapped,
                                            const Misfit& crossed) const {
  const Candidate* rival = swapped.back().candidate;
  FittedStructure best;
  best.log_likelihood = -INFINITY;
  const std::vector<Candidate> expected = ExpectedBeside(block_, swapped, rival->target);
  for (const Candidate& one : expected) {
    const Slot slot = one.mechanism->slot;
    if (slot != Slot::kCommandTiming && slot != Slot::kActuator) continue;
    if (HasSlot(swapped, slot)) continue;  // a mechanism of this slot is already in the structure
    FittedStructure fitted = fitter_.FitNear(With(swapped, one, one.starts.front()));
    if (fitted.log_likelihood > best.log_likelihood) best = std::move(fitted);
  }
  if (best.terms.empty()) return {rival, 0, INFINITY};
  const Candidate& beside = *best.terms.back().candidate;
  std::vector<Structure> both = {best.terms};
  Candidate with_found = beside;
  with_found.starts = {best.terms.back().values};
  with_found = HeldBeside(std::move(with_found), found);
  if (!ActsIn(found, beside) && !with_found.free.empty()) {
    both.push_back(fitter_.FitNear(With(found, with_found, with_found.starts.front())).terms);
  }
  const std::vector<Misfit> left = pruning_.Evaluate(both);
  Rival compared = CompareWith(best.terms, left.front(), left.size() > 1 ? left.back() : crossed);
  compared.candidate = rival;
  return compared;
}

void RivalTests::Discriminate(const Structure& found, const Misfit& crossed,
                              const std::vector<Structure>& swapped, TermEvidence* evidence) const {
  const std::vector<Misfit> left = pruning_.Evaluate(swapped);
  for (std::size_t k = 0; k < swapped.size(); ++k) {
    const Rival rival = CompareWith(swapped[k], left[k], crossed);
    if (!IsRejected(rival) || !IsRejected(CompareWithExpectedBeside(found, swapped[k], crossed))) {
      evidence->rivals.push_back(rival.candidate);
      if (IsExpectedExchange(found, swapped[k])) {
        evidence->expected_rivals.push_back(rival.candidate);
      }
    } else {
      evidence->rejected.push_back(rival);
    }
  }
  std::stable_sort(evidence->rejected.begin(), evidence->rejected.end(),
                   [](const Rival& a, const Rival& b) { return a.lead < b.lead; });
}

}  // namespace tera
