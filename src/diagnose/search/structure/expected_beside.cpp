#include "diagnose/search/structure/expected_beside.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "diagnose/search/fit/structure_fit.h"

namespace tera {
namespace {

/// The parameter restricted to its tolerance. None if the tolerance lies outside its range.
std::optional<FreeParameter> WithinExpected(FreeParameter free) {
  const double range = free.upper - free.lower;
  free.lower = std::max(free.lower, free.expected->value - free.expected->half_width);
  free.upper = std::min(free.upper, free.expected->value + free.expected->half_width);
  if (free.lower >= free.upper) return std::nullopt;
  if (!free.logarithmic) free.kink = std::min(1.0, free.kink * range / (free.upper - free.lower));
  return free;
}

/// Share of the tolerance of its target's delays that a term within tolerance uses, 0 to 1.
double UsedDelay(const Term& term) {
  double used = 0;
  for (const FreeParameter& free : term.candidate->free) {
    if (!free.expected || !free.expected->delays_command || free.expected->half_width <= 0)
      continue;
    const double off = std::abs(term.values[free.index] - free.expected->value);
    used = std::max(used, off / free.expected->half_width);
  }
  return used;
}

}  // namespace

bool IsAsExpected(const Term& term) {
  bool is_stated = false;
  for (const FreeParameter& free : term.candidate->free) {
    if (!free.expected) continue;
    is_stated = true;
    const double off = std::abs(term.values[free.index] - free.expected->value);
    if (off > free.expected->half_width) return false;
  }
  return is_stated;
}

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

Candidate HeldBeside(Candidate candidate, const Structure& terms) {
  double left = 1;
  for (const Term& term : terms) {
    const bool shares = term.candidate->target == candidate.target && IsAsExpected(term);
    if (shares) left -= UsedDelay(term);
  }
  for (FreeParameter& free : candidate.free) {
    if (free.expected && free.expected->delays_command) {
      free.expected->half_width *= std::max(left, 0.0);
    }
  }
  return HeldToExpected(std::move(candidate));
}

std::vector<Candidate> ExpectedBeside(const ReplayBlock& block, const Structure& terms,
                                      const std::string& target) {
  std::vector<Candidate> expected;
  for (const Candidate& candidate : block.candidates) {
    if (candidate.target != target || ActsIn(terms, candidate)) continue;
    Candidate held = HeldBeside(candidate, terms);
    if (!held.free.empty()) expected.push_back(std::move(held));
  }
  return expected;
}

}  // namespace tera
