#include "diagnose/encoder_lead.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tera {
namespace {

constexpr double kLongest_s = 0.5;
constexpr double kLeast_s = 0.03;
constexpr double kTold = 0.5;    ///< share of the rate's energy that a prediction tells
constexpr double kLeft = 0.5;    ///< of what it does not tell without a shift
constexpr double kAgree = 0.25;  ///< of the largest lead

/// Share of a rate's energy that a prediction in proportion to it, `ahead` samples later, tells.
double ToldShare(const Series& rate, const std::vector<double>& predicted, std::size_t ahead) {
  double both = 0, measured = 0, expected = 0;
  for (std::size_t k = 0; k + ahead < predicted.size(); ++k) {
    if (!rate.valid[k]) continue;
    both += rate.value[k] * predicted[k + ahead];
    measured += rate.value[k] * rate.value[k];
    expected += predicted[k + ahead] * predicted[k + ahead];
  }
  return both > 0 ? both * both / (measured * expected) : 0;
}

/// Nought where it is not ahead; none where the prediction does not move or tells too little.
std::optional<double> LeadOf_s(const ReplayBlock& block) {
  const Series& rate = block.channels.front().measured;
  const std::vector<double> predicted = block.predict({}).front();
  const auto longest = static_cast<std::size_t>(kLongest_s / block.period_s());
  const double at_once = ToldShare(rate, predicted, 0);
  double most = at_once;
  std::size_t lead = 0;
  for (std::size_t ahead = 1; ahead <= longest; ++ahead) {
    const double told = ToldShare(rate, predicted, ahead);
    if (told <= most) continue;
    most = told;
    lead = ahead;
  }
  if (most < kTold) return std::nullopt;
  const double lead_s = static_cast<double>(lead) * block.period_s();
  return lead_s >= kLeast_s && 1 - most <= kLeft * (1 - at_once) ? lead_s : 0;
}

}  // namespace

std::optional<double> EncoderLead_s(const std::vector<ReplayBlock>& blocks) {
  std::vector<double> leads_s;
  for (const ReplayBlock& block : blocks) {
    if (!HasLever(block)) continue;
    if (const std::optional<double> lead_s = LeadOf_s(block)) leads_s.push_back(*lead_s);
  }
  if (leads_s.size() < 2) return std::nullopt;
  const auto [least, most] = std::minmax_element(leads_s.begin(), leads_s.end());
  if (*least == 0 || *most - *least > kAgree * *most) return std::nullopt;
  return std::accumulate(leads_s.begin(), leads_s.end(), 0.0) / static_cast<double>(leads_s.size());
}

}  // namespace tera
