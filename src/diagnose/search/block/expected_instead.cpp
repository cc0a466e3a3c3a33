#include "diagnose/search/block/expected_instead.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace tera {
namespace {

constexpr int kMostInstead = 3;  ///< mechanisms that are as expected, in the place of one

/// The same number no further off than is as expected; none where the range ends before.
std::optional<FreeParameter> WithinExpected(FreeParameter free) {
  const double range = free.upper - free.lower;
  free.lower = std::max(free.lower, free.expected->value - free.expected->half_width);
  free.upper = std::min(free.upper, free.expected->value + free.expected->half_width);
  if (free.lower >= free.upper) return std::nullopt;
  if (!free.logarithmic) free.kink = std::min(1.0, free.kink * range / (free.upper - free.lower));
  return free;
}

/// The mechanism held to what is as expected of it; without free numbers where nothing is.
Candidate HeldToExpected(Candidate candidate) {
  std::vector<FreeParameter> within;
  for (const FreeParameter& free : candidate.free) {
    std::optional<FreeParameter> one = free.expected ? WithinExpected(free) : std::nullopt;
    for (std::vector<double>& start : candidate.starts) {
      double& value = start[free.index];
      value = one ? std::clamp(value, one->lower, one->upper)
                  : DefaultOf(candidate, free.index).value_or(value);
    }
    if (one) within.push_back(*std::move(one));
  }
  candidate.free = std::move(within);
  std::sort(candidate.starts.begin(), candidate.starts.end());
  candidate.starts.erase(std::unique(candidate.starts.begin(), candidate.starts.end()),
                         candidate.starts.end());
  return candidate;
}

bool ActsIn(const Structure& terms, const Candidate& candidate) {
  return std::any_of(terms.begin(), terms.end(), [&](const Term& term) {
    return term.candidate->mechanism == candidate.mechanism &&
           term.candidate->target == candidate.target;
  });
}

/// All that is as expected of the target of a term and does not act in the structure yet.
std::vector<Candidate> ExpectedBeside(const ReplayBlock& block, const Structure& found,
                                      std::size_t term) {
  std::vector<Candidate> expected;
  for (const Candidate& candidate : block.candidates) {
    if (candidate.target != found[term].candidate->target || ActsIn(found, candidate)) continue;
    Candidate held = HeldToExpected(candidate);
    if (!held.free.empty()) expected.push_back(std::move(held));
  }
  return expected;
}

}  // namespace

Misfit MisfitOfExpectedInstead(const ReplayBlock& block, const StructureFitter& fitter,
                               const Structure& found, std::size_t term) {
  const std::vector<Candidate> expected = ExpectedBeside(block, found, term);
  FittedStructure best = fitter.FitFrom(Without(found, term));
  for (int added = 0; added < kMostInstead; ++added) {
    const Structure beside = best.terms;
    const double likelihood = best.log_likelihood;
    double most = 0;
    for (const Candidate& one : expected) {
      if (ActsIn(beside, one)) continue;
      Structure with = beside;
      with.push_back({&one, one.starts.front()});
      FittedStructure fitted = fitter.FitNear(with);
      const double gain = fitted.log_likelihood - likelihood - static_cast<double>(one.free.size());
      if (gain <= most) continue;
      most = gain;
      best = std::move(fitted);
    }
    if (most == 0) break;
  }
  return std::move(best.misfit);
}

}  // namespace tera
