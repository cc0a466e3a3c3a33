#include "diagnose/report/text/sensor_text.h"

#include <fmt/format.h>

#include "diagnose/report/text/finding_text.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

std::string TextOf(const SensorFound& found) {
  return fmt::format("{} of the {}", NameAndNumbers(found.finding),
                     Spaced(found.finding.term.candidate->target));
}

std::string ErrorText(const SensorFound& found) {
  if (found.unit.empty()) return "";
  const ReadableUnit unit = ReadableUnitOf(found.unit);
  const HeldOutError& error = found.finding.held_out;
  return fmt::format(" {}: RMSE {} → {}.", Capitalised(QuantityOf(found.channel)),
                     Significant(error.rmse_before * unit.factor, 2),
                     WithUnit(Significant(error.rmse_after * unit.factor, 2), unit));
}

}  // namespace

std::vector<std::string> ComparedSensors(const DiagnosedSensors& sensors) {
  std::vector<std::string> names;
  for (const ChannelError& channel : sensors.estimate.channels) {
    const std::size_t first = channel.name.find('/') + 1;
    const std::string name = Spaced(channel.name.substr(first, channel.name.rfind('/') - first));
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return names;
}

std::vector<std::string> SensorSentences(const DiagnosedSensors& sensors) {
  std::vector<std::string> sentences;
  for (const SensorFound& found : sensors.findings) {
    if (found.finding.parameters.empty()) {
      sentences.push_back(fmt::format("{}: it counts against its lever and the inertial units.{}",
                                      Capitalised(TextOf(found)), ErrorText(found)));
      continue;
    }
    const std::vector<std::string> alike = AlikeTexts(found.finding);
    sentences.push_back(fmt::format(
        "{}, beyond tolerance ({} on parts of the recording that it was not fitted to{}).{}",
        Capitalised(TextOf(found)), ProbabilityText(found.finding.evidence.p),
        alike.empty() ? "" : "; not told apart from: " + Listed(alike), ErrorText(found)));
  }
  return sentences;
}

std::vector<std::string> OtherSensorSentences(const DiagnosedSensors& sensors) {
  std::vector<std::string> sentences, within;
  for (const SensorFound& found : sensors.within_tolerance) within.push_back(TextOf(found));
  if (!within.empty()) {
    sentences.push_back(fmt::format("Within tolerance: {}.", Listed(within)));
  }
  for (const SensorFound& found : sensors.unconfirmed) {
    const std::string what = Capitalised(TextOf(found));
    const std::string p = ProbabilityText(found.finding.evidence.p);
    sentences.push_back(
        found.finding.is_confirmed
            ? fmt::format("{} was chosen ({}) and is not confirmed: what it changes is less than "
                          "noise, or less than half of what else is left.",
                          what, p)
            : fmt::format("{} would lie beyond tolerance, and is not confirmed: not all parts of "
                          "the recording bear it out alike ({}), or something else explains it.",
                          what, p));
  }
  for (const std::vector<TargetMechanism>& set : sensors.estimate.not_told_apart) {
    std::vector<std::string> names;
    for (const TargetMechanism& one : set) names.push_back(one.Name());
    sentences.push_back(fmt::format(
        "Not told apart, for their effects cancel: {}. None of them is named.", Listed(names)));
  }
  for (const std::string& obstacle : sensors.estimate.not_compared) {
    sentences.push_back(fmt::format("Not compared: {}.", obstacle));
  }
  return sentences;
}

}  // namespace tera
