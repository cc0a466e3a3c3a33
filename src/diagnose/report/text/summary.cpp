#include "diagnose/report/text/summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "diagnose/report/text/finding_text.h"
#include "diagnose/report/text/ranking.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

/// The findings on one joint, pump, sensor or the base, as texts.
struct OfTarget {
  std::string target;
  std::vector<std::string> names;
};

void Add(const std::string& target, std::string name, std::vector<OfTarget>* all) {
  auto of = std::find_if(all->begin(), all->end(),
                         [&](const OfTarget& one) { return one.target == target; });
  if (of == all->end()) of = all->insert(all->end(), {target, {}});
  of->names.push_back(std::move(name));
}

std::string WithItsClass(const std::string& name, const std::vector<std::string>& alike) {
  return alike.empty() ? name : fmt::format("{} (or {})", name, fmt::join(alike, " or "));
}

/// Each name once, with its count where there are several: "terrain height in 16 places".
std::vector<std::string> Counted(const std::vector<std::string>& names) {
  std::vector<std::string> counted;
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(names.begin(), name, *name) != name) continue;
    const auto times = std::count(names.begin(), names.end(), *name);
    counted.push_back(times > 1 ? fmt::format("{} in {} places", *name, times) : *name);
  }
  return counted;
}

std::string FoundText(const Diagnosis& diagnosis) {
  std::vector<OfTarget> all;
  const auto add = [&](const Finding& finding) {
    Add(finding.term.candidate->target, WithItsClass(NameAndNumbers(finding), AlikeTexts(finding)),
        &all);
  };
  for (const auto& [diagnosed, finding] : RankedFindings(diagnosis)) add(*finding);
  for (const SensorFound& found : diagnosis.sensors.findings) add(found.finding);
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    for (const PerceptionFinding& found : sensor.findings) add(found.finding);
  }
  std::vector<std::string> parts;
  for (const OfTarget& one : all) {
    parts.push_back(fmt::format("{}: {}", Spaced(one.target), Listed(Counted(one.names))));
  }
  return parts.empty() ? "" : fmt::format(" {}.", fmt::join(parts, "; "));
}

std::string UnexplainedText(const Diagnosis& diagnosis) {
  std::vector<std::string> quantities;
  for (const auto& [diagnosed, unexplained] : RankedUnexplained(diagnosis)) {
    quantities.push_back(QuantityOf(diagnosed->block.channels[unexplained->location.channel].name));
  }
  return quantities.empty() ? "" : fmt::format(" Unexplained: {}.", Listed(quantities));
}

}  // namespace

std::string SummaryOf(const Diagnosis& diagnosis) {
  const std::string found = FoundText(diagnosis), unexplained = UnexplainedText(diagnosis);
  if (found.empty() && unexplained.empty()) return "";
  return fmt::format("In short:{}{}", found.empty() ? " nothing named." : found, unexplained);
}

}  // namespace tera
