#include "dataset/lint/lint_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "core/config/config.h"
#include "core/error.h"
#include "dataset/format/events_table.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

/// Number of places listed per finding; further places are only counted.
constexpr std::size_t kPlacesKept = 5;

std::map<int, std::string> ReadClasses(const fs::path& description) {
  const Config config = Config::FromFile(description);
  std::map<int, std::string> names;
  for (const ConfigMap& item : config.root().List("classes")) {
    names[static_cast<int>(item.Integer("id", Between(0, 255, "")))] = item.Text("name");
  }
  return names;
}

}  // namespace

LintJob::LintJob(const Recording& recording, const LintOptions& options)
    : recording_(recording),
      options_(options),
      class_names_(ReadClasses(recording.directory() / "dataset.yaml")) {
  for (const DatasetInfo::Instance& instance : recording.info().instances) {
    instances_.emplace(instance.id, instance);
  }
}

void LintJob::Find(RuleId rule, const std::string& channel, LintPlace place) {
  Applies(rule);
  LintFinding& finding = findings_[{rule.index(), channel}];
  finding.rule = &rule.rule();
  finding.channel = channel;
  ++finding.count;
  if (finding.places.size() < kPlacesKept) finding.places.push_back(std::move(place));
}

void LintJob::Try(const std::string& channel, const std::function<void()>& check) {
  if (IsLeftOut(channel)) return;
  try {
    check();
  } catch (const InternalError&) {
    throw;
  } catch (const std::exception& e) {  // libraries throw exceptions of their own
    Find("dataset.unchecked", channel, {channel, 0, e.what()});
  }
}

std::optional<SensorSheet> LintJob::SheetOf(const std::string& channel) const {
  try {
    return ReadSensorSheet(recording_.directory() / channel);
  } catch (const InputError&) {
    return std::nullopt;  // reported by files.sheet
  }
}

std::string LintJob::RowsOf(const std::string& channel) const {
  const std::string_view type = recording_.TypeOf(channel);
  const bool is_file = type == kTableChannel || type == kPoseChannel || type == kEventsChannel;
  return is_file ? channel : channel + "/data.csv";
}

std::string LintJob::ClassName(int id) const {
  const auto found = class_names_.find(id);
  return found == class_names_.end() ? "" : found->second;
}

const DatasetInfo::Instance* LintJob::InstanceOf(std::uint16_t id) const {
  const auto found = instances_.find(id);
  return found == instances_.end() ? nullptr : &found->second;
}

LintReport LintJob::Report() && {
  LintReport report;
  report.dataset = recording_.directory();
  report.name = recording_.info().scenario_name;
  for (auto& [key, finding] : findings_) report.findings.push_back(std::move(finding));
  std::stable_sort(report.findings.begin(), report.findings.end(),
                   [](const LintFinding& a, const LintFinding& b) {
                     return a.rule->severity < b.rule->severity;
                   });
  for (std::size_t i = 0; i < kLintRules.size(); ++i) {
    (applied_.contains(i) ? report.applied : report.not_applicable).push_back(&kLintRules[i]);
  }
  report.statistics = std::move(statistics_);
  return report;
}

std::string MachineOfChannel(const std::string& channel) {
  const fs::path path(channel);
  auto part = path.begin();
  if (part != path.end() && *part == "truth") ++part;
  return part == path.end() ? "" : part->string();
}

}  // namespace tera
