#include "diagnose/report/text/clock_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

/// Delays count as the same where they differ by less than this share of the longer one, or by less
/// than so many standard deviations, but never by more than kMostDifference of the longer one.
constexpr double kSameShare = 0.2, kSameDeviations = 3, kMostDifference = 0.5;

std::optional<ParameterEstimate> DelayOf(const DiagnosedBlock& diagnosed) {
  for (const Finding& finding : diagnosed.diagnosis.findings) {
    if (finding.term.candidate->mechanism->id == "command_delay") return finding.parameters.front();
  }
  return std::nullopt;
}

bool AreTheSame(const ParameterEstimate& shortest, const ParameterEstimate& longest) {
  const double sigma = std::hypot(shortest.sigma.value_or(0), longest.sigma.value_or(0));
  const double uncertain = std::min(kSameDeviations * sigma, kMostDifference * longest.value);
  return longest.value - shortest.value <= std::max(kSameShare * longest.value, uncertain);
}

}  // namespace

std::string SentenceOfSharedDelay(const Diagnosis& diagnosis) {
  std::vector<ParameterEstimate> delays;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    if (!diagnosed.diagnosis.is_testable || !HasLever(diagnosed.block)) continue;
    const std::optional<ParameterEstimate> delay = DelayOf(diagnosed);
    if (!delay) return "";
    delays.push_back(*delay);
  }
  if (delays.size() < 2) return "";
  const auto [shortest, longest] = std::minmax_element(
      delays.begin(), delays.end(),
      [](const ParameterEstimate& a, const ParameterEstimate& b) { return a.value < b.value; });
  if (!AreTheSame(*shortest, *longest)) return "";
  double mean_s = 0;
  for (const ParameterEstimate& delay : delays) mean_s += delay.value / delays.size();
  return fmt::format(
      "All {} joints and tracks that follow levers ask for a delay of about {} s: the clock of the "
      "encoders, or of the levers, "
      "may be off by it instead, which is not told apart.",
      delays.size(), Significant(mean_s, 2));
}

std::string SentenceOfEncoderLead(const Diagnosis& diagnosis) {
  if (!diagnosis.encoder_lead_s) return "";
  return fmt::format(
      "Encoders run ahead of the levers that move them, by about {} s: their clocks differ. Mend "
      "that first; what is named below may be a proxy for it.",
      Significant(*diagnosis.encoder_lead_s, 2));
}

}  // namespace tera
