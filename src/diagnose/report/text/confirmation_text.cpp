#include "diagnose/report/text/confirmation_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "diagnose/report/text/words.h"

namespace tera {
namespace {

/// Gain in log-likelihood at which a recording shows that a discrepancy exists, or that none does.
constexpr double kLeastShownGain = 10;

/// "boom rate 3.1 → 0.6 deg/s".
std::string ChangeText(const std::string& channel, const std::string& si_unit, double before,
                       double after) {
  return QuantityOf(channel) + " " + Change(before, after, si_unit);
}

std::vector<std::string> Quantities(const std::vector<std::string>& channels) {
  std::vector<std::string> names;
  for (const std::string& channel : channels) names.push_back(QuantityOf(channel));
  return names;
}

constexpr double kLeastPath_m = 0.005;  ///< path of a base that moves

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
    const std::string amount =
        fmt::format("{} {}", QuantityOf(one.channel), Readable(one.rms, one.unit));
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

namespace {

std::vector<std::string> SpacedAll(const std::vector<std::string>& identifiers) {
  std::vector<std::string> names;
  for (const std::string& identifier : identifiers) names.push_back(Spaced(identifier));
  return names;
}

constexpr std::size_t kMostNamed = 3;  ///< mechanisms per target; more are counted

/// Undetectable mechanisms by target: "backlash and sag of the boom", "12 mechanisms of the slew".
std::vector<std::string> Shown(const std::vector<DiscriminatedSet>& sets) {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_target;
  for (const DiscriminatedSet& set : sets) {
    if (set.is_class) continue;
    if (by_target.empty() || by_target.back().first != set.target) {
      by_target.push_back({set.target, {}});
    }
    by_target.back().second.push_back(Spaced(set.members.front()));
  }
  std::vector<std::string> parts;
  for (const auto& [target, names] : by_target) {
    const std::string what =
        names.size() > kMostNamed ? fmt::format("{} mechanisms", names.size()) : Listed(names);
    parts.push_back(fmt::format("{} of the {}", what, Spaced(target)));
  }
  return parts;
}

}  // namespace

std::string SentenceOf(const NextManoeuvre& next) {
  std::vector<std::string> does;
  for (const DiscriminatedSet& set : next.discriminated) {
    if (!set.is_class) continue;
    does.push_back(fmt::format("tells {} of the {} apart", Listed(SpacedAll(set.members)),
                               Spaced(set.target)));
  }
  if (const auto shown = Shown(next.discriminated); !shown.empty()) {
    does.push_back("would show " + Listed(shown));
  }
  std::string text = fmt::format("Next manoeuvre ({}, {:.0f} s; {}): {}. Power {} at least.",
                                 kNextManoeuvreFile, next.duration_s, next.description,
                                 fmt::join(does, "; "), Significant(next.power, 2));
  for (const DiscriminatedSet& set : next.not_discriminated) {
    if (!set.is_class) continue;
    text += fmt::format(" It does not tell {} of the {} apart.", Listed(SpacedAll(set.members)),
                        Spaced(set.target));
  }
  if (!next.deferred.empty()) {
    text += fmt::format(" Left for another: {}.", Listed(SpacedAll(next.deferred)));
  }
  return text;
}

std::string CsvOf(const NextManoeuvre& next) {
  std::string csv = fmt::format("t_ns,{}\n", fmt::join(next.commands.columns, ","));
  for (std::size_t r = 0; r < next.commands.rows.size(); ++r) {
    csv += fmt::format("{}", next.commands.t_ns[r]);
    for (const double lever : next.commands.rows[r]) csv += fmt::format(",{:.4g}", lever);
    csv += "\n";
  }
  return csv;
}

}  // namespace tera
