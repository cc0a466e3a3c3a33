#include "diagnose/report/text/confirmation_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

/// Gain in log-likelihood by which a recording shows a discrepancy, or shows that there is none.
constexpr double kLeastShownGain = 10;

/// "boom rate 3.1 → 0.6 deg/s".
std::string ChangeText(const std::string& channel, const std::string& si_unit, double before,
                       double after) {
  const ReadableUnit unit = ReadableUnitOf(si_unit);
  return fmt::format("{} {} → {}", QuantityOf(channel), Significant(before * unit.factor, 2),
                     WithUnit(Significant(after * unit.factor, 2), unit));
}

std::vector<std::string> Quantities(const std::vector<std::string>& channels) {
  std::vector<std::string> names;
  for (const std::string& channel : channels) names.push_back(QuantityOf(channel));
  return names;
}

constexpr double kLeastPath_m = 0.005;  ///< of a base that moves

std::string LengthText(double length_m) {
  return length_m < kLeastPath_m ? "0" : Significant(length_m, 4);
}

bool GoesNowhere(const PathLengths& path) {
  return std::max(path.before_m, path.after_m) < kLeastPath_m;
}

}  // namespace

std::string SentenceOf(const HeldOutRecording& further) {
  std::vector<std::string> changes;
  for (const HeldOutChannel& one : further.channels) {
    changes.push_back(ChangeText(one.channel, one.unit, one.rmse_before, one.rmse_after));
  }
  std::string text = fmt::format("On {}, which nothing was fitted to: RMSE of {}.",
                                 further.recording, fmt::join(changes, ", "));
  if (changes.empty()) {
    text = fmt::format("{} has no channel of those that were judged.", further.recording);
  }
  if (!further.missing.empty()) {
    text += fmt::format(" It says nothing of {}.", Listed(Quantities(further.missing)));
  }
  return text;
}

std::string SentenceOf(const WholeSimulation& whole) {
  if (!whole.obstacle.empty()) {
    return fmt::format("Without a whole simulation to confirm it: {}.", whole.obstacle);
  }
  std::vector<std::string> changes, not_followed;
  for (const SimulatedChannel& one : whole.channels) {
    changes.push_back(ChangeText(one.channel, one.unit, one.rmse_before, one.rmse_after));
    if (!one.Follows()) not_followed.push_back(QuantityOf(one.channel));
  }
  std::string text = fmt::format(
      "The whole simulation as it was and with what was found, {:.0f}–{:.0f} s, manoeuvres kept "
      "back: {}",
      whole.from_s, whole.until_s,
      changes.empty() ? std::string("no channel of a joint, track or the base") : Listed(changes));
  if (whole.path) {
    text +=
        fmt::format("; path {} m recorded, {} → {} m simulated", LengthText(whole.path->recorded_m),
                    LengthText(whole.path->before_m), LengthText(whole.path->after_m));
    if (GoesNowhere(*whole.path)) text += ": the simulated base goes nowhere";
  }
  text += ".";
  if (!not_followed.empty()) {
    text += fmt::format(" The whole simulation does not follow: {}.", Listed(not_followed));
  }
  if (!whole.not_simulated.empty()) {
    text += fmt::format(" Not simulated: {}.", Listed(Quantities(whole.not_simulated)));
  }
  return text;
}

std::string SentenceOf(const std::vector<DiscrepancyCorrection>& corrections) {
  std::vector<std::string> applied, not_shown, not_simulated;
  for (const DiscrepancyCorrection& one : corrections) {
    const ReadableUnit unit = ReadableUnitOf(one.unit);
    const std::string amount = fmt::format("{} {}", QuantityOf(one.channel),
                                           WithUnit(Significant(one.rms * unit.factor, 2), unit));
    if (!one.is_simulated) not_simulated.push_back(QuantityOf(one.channel));
    if (one.is_simulated && one.gain > kLeastShownGain) applied.push_back(amount);
    if (one.is_simulated && one.gain < -kLeastShownGain) not_shown.push_back(amount);
  }
  std::vector<std::string> parts;
  if (!applied.empty()) {
    parts.push_back(fmt::format("Corrected for what the replays lack of the simulation: {} (RMS).",
                                Listed(applied)));
  }
  if (!not_shown.empty()) {
    parts.push_back(
        fmt::format("Lacking in the replays, but not seen in the recording either: {} (RMS).",
                    Listed(not_shown)));
  }
  if (!not_simulated.empty()) {
    parts.push_back(
        fmt::format("Not simulated as a whole: {}; what a replay lacks counts as a difference.",
                    Listed(not_simulated)));
  }
  return fmt::format("{}", fmt::join(parts, " "));
}

}  // namespace tera
