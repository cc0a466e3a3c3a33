#include "diagnose/encoder_clocks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnose/tolerances/default_tolerances.h"

namespace tera {
namespace {

constexpr double kLongestLead_s = 0.5;
/// Least share of the rate's energy that the best shift explains. Below it, the encoder has no
/// estimate.
constexpr double kLeastExplainedShare = 0.5;
/// Largest residual energy of the best shift, over that of no shift.
constexpr double kMostLeftOfUnshifted = 0.5;
/// Largest relative spread of leads: one clock gives all encoders the same lead.
constexpr double kMostSpread = 0.25;

/// Share of a rate's energy that a factor times the prediction explains. The prediction is taken
/// `ahead` samples later.
double ExplainedShare(const Series& rate, const std::vector<double>& predicted, std::size_t ahead) {
  double both = 0, measured = 0, expected = 0;
  for (std::size_t k = 0; k + ahead < predicted.size(); ++k) {
    if (!rate.valid[k]) continue;
    both += rate.value[k] * predicted[k + ahead];
    measured += rate.value[k] * rate.value[k];
    expected += predicted[k + ahead] * predicted[k + ahead];
  }
  return both > 0 ? both * both / (measured * expected) : 0;
}

/// Lead of one block's encoder; 0 if it does not run ahead. Returns nothing if the prediction
/// explains too little.
std::optional<double> LeadOf_s(const ReplayBlock& block) {
  const Series& rate = block.channels.front().measured;
  const std::vector<double> predicted = block.predict({}).front();
  const auto longest = static_cast<std::size_t>(kLongestLead_s / block.period_s());
  const double at_once = ExplainedShare(rate, predicted, 0);
  double most = at_once;
  std::size_t lead = 0;
  for (std::size_t ahead = 1; ahead <= longest; ++ahead) {
    const double explained = ExplainedShare(rate, predicted, ahead);
    if (explained <= most) continue;
    most = explained;
    lead = ahead;
  }
  if (most < kLeastExplainedShare) return std::nullopt;
  const double lead_s = static_cast<double>(lead) * block.period_s();
  return lead_s > kStampTolerance_s && 1 - most <= kMostLeftOfUnshifted * (1 - at_once) ? lead_s
                                                                                        : 0;
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
  if (*least == 0 || *most - *least > kMostSpread * *most) return std::nullopt;
  return std::accumulate(leads_s.begin(), leads_s.end(), 0.0) / static_cast<double>(leads_s.size());
}

namespace {

/// Log-likelihood of all rates under their levers, up to a constant that does not depend on stamps.
/// The sum over axes is -n/2 log(1 - s). Here n is the number of samples, and s the energy share
/// that a factor times the prediction explains.
double LikelihoodByLevers(const std::vector<ReplayBlock>& blocks) {
  double sum = 0;
  for (const ReplayBlock& block : blocks) {
    if (!HasLever(block)) continue;
    const Series& rate = block.channels.front().measured;
    const std::vector<double> predicted = block.predict({}).front();
    sum -= 0.5 * static_cast<double>(CountValid(rate.valid)) *
           std::log(1 - ExplainedShare(rate, predicted, 0));
  }
  return sum;
}

}  // namespace

bool StampEncodersAnew(const DiagnosisInput& input, const SensorDiagnosis& estimate,
                       const BlockOptions& options, Measurements* measured) {
  BlockOptions of_axes = options;
  of_axes.needs_any = false;
  const auto likelihood = [&](const std::vector<NamedEncoders>& encoders) {
    Measurements alone{.recording = measured->recording, .encoders = encoders};
    alone.imus.resize(measured->imus.size());
    alone.gnss.resize(measured->gnss.size());
    alone.start_ns = measured->start_ns;
    return LikelihoodByLevers(BlocksOf(input, alone, of_axes));
  };
  bool has_changed = false;
  for (const SensorFinding& found : estimate.findings) {
    if (found.mechanism->id != "clock_offset" || !found.rivals.empty()) continue;
    std::vector<NamedEncoders> anew = measured->encoders;
    bool is_encoder = false;
    for (NamedEncoders& encoders : anew) {
      if (encoders.channel != input.machine + "/" + found.target) continue;
      is_encoder = true;
      for (EncoderSample& sample : encoders.recording.samples) {
        sample.t_ns -= FromSeconds(found.numbers.front().value);
      }
    }
    if (!is_encoder || likelihood(anew) <= likelihood(measured->encoders)) continue;
    measured->encoders = std::move(anew);
    has_changed = true;
  }
  return has_changed;
}

}  // namespace tera
