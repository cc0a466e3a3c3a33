#include "diagnose/report/text/cause.h"

#include <algorithm>
#include <set>

#include "diagnose/report/text/ranking.h"
#include "diagnose/report/text/wording.h"

namespace tera {

std::string Cause::ErrorUnit() const {
  if (block != nullptr) return block->block.channels[finding->held_out.channel].unit;
  return sensor != nullptr ? sensor->unit : seen_by->unit;
}

std::string Cause::Quantity() const {
  if (block != nullptr) return QuantityOf(block->block.channels[finding->held_out.channel].name);
  if (sensor != nullptr) return sensor->unit.empty() ? "" : QuantityOf(sensor->channel);
  return seen_by->unit == "m" ? "distance to the simulated surfaces"
                              : "distance to the simulated edges";
}

double Cause::ErrorRatio() const {
  const HeldOutError& error = finding->held_out;
  return error.rmse_after > 0 ? error.rmse_before / error.rmse_after : 0;
}

std::vector<Cause> CausesOf(const Diagnosis& diagnosis) {
  std::vector<Cause> causes;
  for (const auto& [diagnosed, finding] : RankedFindings(diagnosis)) {
    causes.push_back({.finding = finding, .block = diagnosed});
  }
  for (const SensorFound& found : diagnosis.sensors.findings) {
    causes.push_back({.finding = &found.finding, .sensor = &found});
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    for (const PerceptionFinding& found : sensor.findings) {
      causes.push_back({.finding = &found.finding, .seen_by = &sensor, .seen = &found});
    }
  }
  std::stable_sort(causes.begin(), causes.end(),
                   [](const Cause& a, const Cause& b) { return a.ErrorRatio() > b.ErrorRatio(); });
  return causes;
}

std::vector<const ChannelError*> UnexplainedOfSensors(const Diagnosis& diagnosis) {
  std::set<std::string> judged;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    if (!diagnosed.diagnosis.is_testable) continue;
    for (const Channel& channel : diagnosed.block.channels) judged.insert(channel.name);
  }
  std::vector<const ChannelError*> left;
  for (const ChannelError& channel : diagnosis.sensors.estimate.channels) {
    if (!IsExplained(channel) && !judged.contains(channel.name)) left.push_back(&channel);
  }
  return left;
}

std::vector<const Candidate*> RivalsOf(const Finding& finding) {
  std::vector<const Candidate*> rivals = finding.evidence.rivals;
  std::erase(rivals, finding.term.candidate);
  return rivals;
}

}  // namespace tera
