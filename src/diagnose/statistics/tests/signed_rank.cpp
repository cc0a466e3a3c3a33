#include "diagnose/statistics/tests/signed_rank.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace tera {
namespace {

constexpr std::size_t kLargestExact = 50;  ///< differences of which the distribution is enumerated

/// Twice the mean rank of each |value|, which is whole; values are sorted by |.|.
std::vector<std::size_t> DoubledRanks(const std::vector<double>& sorted) {
  std::vector<std::size_t> ranks(sorted.size());
  for (std::size_t begin = 0; begin < sorted.size();) {
    std::size_t end = begin;
    while (end < sorted.size() && std::abs(sorted[end]) == std::abs(sorted[begin])) ++end;
    std::fill(ranks.begin() + begin, ranks.begin() + end, begin + end + 1);
    begin = end;
  }
  return ranks;
}

/// The probability of each doubled rank sum s under random signs, at index s.
std::vector<double> SumDistribution(const std::vector<std::size_t>& doubled_ranks) {
  std::vector<double> probability{1.0};
  for (const std::size_t rank : doubled_ranks) {
    std::vector<double> next(probability.size() + rank, 0.0);
    for (std::size_t s = 0; s < probability.size(); ++s) {
      next[s] += probability[s] / 2;
      next[s + rank] += probability[s] / 2;
    }
    probability = std::move(next);
  }
  return probability;
}

void JudgeExactly(const std::vector<std::size_t>& ranks, std::size_t doubled_sum, SignedRank* out) {
  const std::vector<double> probability = SumDistribution(ranks);
  out->p_less = out->p_greater = 0;
  for (std::size_t s = 0; s < probability.size(); ++s) {
    if (s <= doubled_sum) out->p_less += probability[s];
    if (s >= doubled_sum) out->p_greater += probability[s];
  }
}

void JudgeNormally(const std::vector<std::size_t>& ranks, SignedRank* out) {
  double mean = 0, variance = 0;
  for (const std::size_t doubled : ranks) {
    const double rank = static_cast<double>(doubled) / 2;
    mean += rank / 2;
    variance += rank * rank / 4;
  }
  const boost::math::normal normal(mean, std::sqrt(variance));
  out->exact = false;
  out->p_less = boost::math::cdf(normal, out->positive_sum + 0.5);
  out->p_greater = boost::math::cdf(boost::math::complement(normal, out->positive_sum - 0.5));
}

}  // namespace

SignedRank TestSignedRank(const std::vector<double>& differences) {
  std::vector<double> sorted;
  for (const double d : differences) {
    if (d != 0) sorted.push_back(d);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](double a, double b) { return std::abs(a) < std::abs(b); });
  SignedRank out;
  out.count = sorted.size();
  if (sorted.empty()) return out;
  const std::vector<std::size_t> ranks = DoubledRanks(sorted);
  std::size_t doubled_sum = 0;
  for (std::size_t k = 0; k < sorted.size(); ++k) doubled_sum += sorted[k] > 0 ? ranks[k] : 0;
  out.positive_sum = static_cast<double>(doubled_sum) / 2;
  if (out.count <= kLargestExact) {
    JudgeExactly(ranks, doubled_sum, &out);
  } else {
    JudgeNormally(ranks, &out);
  }
  out.p_two_sided = std::min(1.0, 2 * std::min(out.p_less, out.p_greater));
  return out;
}

}  // namespace tera
