#include "campaign/plan/rule_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/overloaded.h"
#include "sim/run/pose_log.h"
#include "sim/run/truth_log.h"

namespace tera {
namespace {

bool HasCamera(const Scenario& scenario, const std::string& path) {
  for (const ScenarioMachine& machine : scenario.machines) {
    for (const SensorDescription& sensor : machine.sensors) {
      if (TypeOf(sensor) != kCameraChannel) continue;
      if (path.empty() || path == machine.placement.name + "/" + sensor.name) return true;
    }
  }
  return false;
}

/// True if an object of the class can occur. Machines and the ground have several classes.
bool MayBeSeen(const Scenario& scenario, SemanticClass label) {
  constexpr SemanticClass kOfObstacles[] = {SemanticClass::kTruck, SemanticClass::kPerson,
                                            SemanticClass::kRock,  SemanticClass::kBarrier,
                                            SemanticClass::kCone,  SemanticClass::kVegetation};
  if (std::find(std::begin(kOfObstacles), std::end(kOfObstacles), label) ==
      std::end(kOfObstacles)) {
    return true;
  }
  return std::any_of(scenario.obstacles.begin(), scenario.obstacles.end(),
                     [&](const ScenarioObstacle& obstacle) { return obstacle.label == label; });
}

/// Collects the channels that the logs of a run add.
class ChannelList : public MeasurementSink {
 public:
  ChannelId AddChannel(const ChannelInfo& info) override {
    channels.push_back(info);
    return static_cast<ChannelId>(channels.size() - 1);
  }
  void Write(ChannelId, Measurement) override {}
  bool NeedsFrame(ChannelId, TimeNs, TimeNs) const override { return false; }
  void MarkPresent(ChannelId, TimeNs) override {}

  std::vector<ChannelInfo> channels;
};

bool HasColumn(const Scenario& scenario, const TableColumn& figure) {
  if (figure.table.starts_with("truth/") || figure.table.ends_with("/commands.csv")) {
    ChannelList list;
    const TruthLog truth(scenario, &list);
    const PoseLog poses(scenario, &list);
    for (const ChannelInfo& channel : list.channels) {
      if (channel.path != figure.table) continue;
      return std::find(channel.columns.begin(), channel.columns.end(), figure.column) !=
             channel.columns.end();
    }
    return false;
  }
  return true;  // a column of a sensor is checked after the run
}

bool HasMachine(const Scenario& scenario, const std::string& name) {
  return std::any_of(
      scenario.machines.begin(), scenario.machines.end(),
      [&](const ScenarioMachine& machine) { return machine.placement.name == name; });
}

bool MayMeet(const Scenario& scenario, const AcceptanceRule& rule) {
  return std::visit(
      Overloaded{[&](const SeenShare& seen) {
                   return HasCamera(scenario, seen.camera) &&
                          (rule.at_least <= 0 || MayBeSeen(scenario, seen.label));
                 },
                 [&](const TableColumn& column) { return HasColumn(scenario, column); },
                 [&](const LargestTilt& tilt) { return HasMachine(scenario, tilt.machine); }},
      rule.figure);
}

std::string WhatIsMissing(const AcceptanceRule& rule) {
  return std::visit(
      Overloaded{
          [&](const SeenShare& seen) {
            return fmt::format("a camera{} and something of class {}",
                               seen.camera.empty() ? "" : " " + seen.camera, NameOf(seen.label));
          },
          [&](const TableColumn& column) {
            return fmt::format("the column {} in {}", column.column, column.table);
          },
          [&](const LargestTilt& tilt) { return fmt::format("a machine {}", tilt.machine); }},
      rule.figure);
}

}  // namespace

void RuleCheck::Look(const Scenario& scenario) {
  for (std::size_t r = 0; r < met_.size(); ++r) {
    met_[r] = met_[r] || MayMeet(scenario, campaign_.rules[r]);
  }
}

void RuleCheck::Finish() const {
  std::vector<InputFault> faults;
  for (std::size_t r = 0; r < met_.size(); ++r) {
    if (met_[r]) continue;
    const AcceptanceRule& rule = campaign_.rules[r];
    faults.emplace_back(
        FaultKind::kNoSuchName,
        fmt::format(
            "no episode can meet rule '{}'; need {} in the scenario, its randomise: or a factor",
            rule.name, WhatIsMissing(rule)),
        rule.place);
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace tera
