#include "campaign/plan/design.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/random.h"

namespace tera {
namespace {

/// Stratum of an episode in the factor's random permutation of strata. A Feistel network permutes
/// the next power of four. A result beyond the number of strata is permuted again (Black, Rogaway
/// 2002).
int StratumOf(const Stream& stream, int count, int number) {
  constexpr std::uint64_t kRounds = 8;
  int half_bits = 1;
  while ((std::int64_t{1} << (2 * half_bits)) < count) ++half_bits;
  const std::uint64_t size = std::uint64_t{1} << half_bits;
  auto place = static_cast<std::uint64_t>(number);
  do {
    std::uint64_t left = place / size, right = place % size;
    for (std::uint64_t round = 0; round < kRounds; ++round) {
      const double share = stream.Uniform(round * size + right);
      left ^= static_cast<std::uint64_t>(share * static_cast<double>(size));
      std::swap(left, right);
    }
    place = left * size + right;
  } while (place >= static_cast<std::uint64_t>(count));
  return static_cast<int>(place);
}

/// Positions in (0, 1), one per factor.
std::vector<double> LatinHypercube(const Campaign& campaign, int number) {
  std::vector<double> shares;
  for (const DesignFactor& factor : campaign.factors) {
    const Stream order(campaign.seed, campaign.name + "/strata/" + factor.key),
        within(campaign.seed, campaign.name + "/stratum/" + factor.key);
    const int stratum = StratumOf(order, campaign.episodes, number);
    shares.push_back((stratum + within.Uniform(static_cast<std::uint64_t>(number))) /
                     campaign.episodes);
  }
  return shares;
}

std::vector<double> Sobol(const Campaign& campaign, int number) {
  const std::size_t count = campaign.factors.size();
  if (count == 0) return {};
  boost::random::sobol sequence(count);
  // Boost's sequence starts after the origin
  sequence.discard(count * static_cast<std::size_t>(number));
  std::vector<double> shares;
  const double all = std::ldexp(1.0, 64);
  for (std::size_t f = 0; f < count; ++f) {
    shares.push_back(static_cast<double>(sequence()) / all);
  }
  return shares;
}

std::string ValueAt(const DesignFactor& factor, double share) {
  if (!factor.levels.empty()) {
    const auto count = static_cast<double>(factor.levels.size());
    const auto level = static_cast<std::size_t>(std::min(share * count, count - 1));
    return factor.levels[level];
  }
  return fmt::format("{}", factor.is_log
                               ? factor.least * std::pow(factor.most / factor.least, share)
                               : factor.least + share * (factor.most - factor.least));
}

std::vector<SetValue> FullFactorial(const Campaign& campaign, int number) {
  std::vector<SetValue> values;
  auto cell = static_cast<std::size_t>(number);
  for (auto factor = campaign.factors.rbegin(); factor != campaign.factors.rend(); ++factor) {
    values.push_back({factor->key, factor->levels[cell % factor->levels.size()]});
    cell /= factor->levels.size();
  }
  std::reverse(values.begin(), values.end());
  return values;
}

}  // namespace

std::vector<SetValue> DesignPoint(const Campaign& campaign, int number) {
  if (campaign.design == Design::kFull) return FullFactorial(campaign, number);
  const std::vector<double> shares = campaign.design == Design::kSobol
                                         ? Sobol(campaign, number)
                                         : LatinHypercube(campaign, number);
  std::vector<SetValue> values;
  for (std::size_t f = 0; f < shares.size(); ++f) {
    values.push_back({campaign.factors[f].key, ValueAt(campaign.factors[f], shares[f])});
  }
  return values;
}

}  // namespace tera
