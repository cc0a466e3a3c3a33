#include "layout/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "core/check.h"
#include "core/error.h"
#include "render/air/weather.h"
#include "sensors/lidar/lidar_view.h"

namespace tera {
namespace {

constexpr double kBytesPerMbyte = 1e6;

}  // namespace

std::vector<std::string> FlatWarnings(const Layout& layout) {
  std::vector<std::string> warnings;
  for (const Viewer& viewer : layout.viewers) {
    if (!viewer.field.is_flat) continue;
    warnings.push_back(
        fmt::format("{}: all beams have one elevation and sweep a surface without volume; this "
                    "lidar counts as blind, although it measures points on that surface; need a "
                    "lidar with beams at several elevations",
                    viewer.name));
  }
  return warnings;
}

Expense ExpenseOf(const Layout& layout) {
  Expense sum;
  for (const SensorDescription& sensor : layout.sensors) {
    sum.cost += sensor.cost;
    sum.power_w += sensor.power_w;
    ++sum.sensors;
    sum.priced += sensor.cost > 0;
    sum.powered += sensor.power_w > 0;
    const std::optional<ViewField> view = ViewOf(sensor);
    if (view) sum.data_mbyteps += view->bytes_per_sample * view->samples_per_s / kBytesPerMbyte;
  }
  return sum;
}

StudiedMachine FindMachine(const LayoutStudy& study, const Scenario& scenario) {
  StudiedMachine found;
  std::vector<std::string> machines;
  for (const ScenarioMachine& machine : scenario.machines) {
    machines.push_back(machine.placement.name);
  }
  if (!study.machine.empty()) {
    const auto at = std::find(machines.begin(), machines.end(), study.machine);
    if (at == machines.end()) {
      throw InputError(
          study.machine_place,
          {FaultKind::kNoSuchName, fmt::format("'{}' is not in the scenario; its machines are {}",
                                               study.machine, fmt::join(machines, ", "))});
    }
    found.machine = static_cast<std::size_t>(at - machines.begin());
  }
  const MachineModel& model = scenario.machines.at(found.machine).placement.model;
  found.upper = model.joints.empty() ? 0 : model.joints.front().child;
  if (study.upper.empty()) return found;
  found.upper = model.LinkIndex(study.upper);
  if (found.upper < 0) {
    std::vector<std::string> links;
    for (const Link& link : model.links) links.push_back(link.name);
    throw InputError(study.upper_place,
                     {FaultKind::kNoSuchName,
                      fmt::format("machine '{}' has no link '{}'; its links are {}",
                                  machines[found.machine], study.upper, fmt::join(links, ", "))});
  }
  return found;
}

Layout LayoutOfSensors(std::vector<SensorDescription> sensors, const MachineModel& model) {
  Layout layout;
  layout.sensors = std::move(sensors);
  for (const SensorDescription& sensor : layout.sensors) {
    const std::optional<ViewField> field = ViewOf(sensor);
    if (!field) continue;
    const Mounting mounting = TrueMounting(sensor, layout.sensors);
    layout.viewers.push_back(
        {sensor.name, *field, model.LinkIndex(mounting.link), mounting.X_BT, Pose::Identity()});
  }
  return layout;
}

Layout LoadLayout(const std::filesystem::path& file, const Cycle& cycle, std::size_t machine) {
  Scenario scenario = cycle.WithRig(machine, file);
  ScenarioMachine& with_rig = scenario.machines[machine];
  Layout layout = LayoutOfSensors(std::move(with_rig.sensors), with_rig.placement.model);
  layout.name = file.stem().string();
  layout.file = file;
  if (layout.viewers.empty()) {
    throw InputError(file.string(),
                     {FaultKind::kMissing,
                      "has no lidar and no camera; need at least one to evaluate coverage"});
  }
  return layout;
}

void PutInAir(const AirStudy& air, Layout* layout) {
  const Weather weather{.visibility_m = air.visibility_m,
                        .rain_mmph = air.rain_mmph,
                        .snowfall_mmph = air.snowfall_mmph};
  const double extinction_1pm = weather.Extinction_1pm();
  if (extinction_1pm <= 0) return;
  const SensedAir sensed{.rain_mmph = air.rain_mmph,
                         .snowfall_mmph = air.snowfall_mmph,
                         .visibility_m = air.visibility_m};
  const double contrast_m = -std::log(kVisibleContrast) / extinction_1pm;
  for (Viewer& viewer : layout->viewers) {
    const auto sensor =
        std::find_if(layout->sensors.begin(), layout->sensors.end(),
                     [&](const SensorDescription& one) { return one.name == viewer.name; });
    TERA_CHECK(sensor != layout->sensors.end(), viewer.name);
    if (const auto* lidar = std::get_if<LidarModel>(&sensor->model)) {
      viewer.field.reach_m = [model = *lidar, sensed](double returned) {
        return ReachInAir_m(model, sensed, returned);
      };
    } else {
      viewer.field.reach_m = [clear = viewer.field.reach_m, contrast_m](double returned) {
        return std::min(clear(returned), contrast_m);
      };
    }
  }
}

void MoveViewers(const MachineState& machine, Layout* layout) {
  for (Viewer& viewer : layout->viewers) {
    viewer.X_WS = machine.links[viewer.link].X_WB * viewer.X_BS;
  }
}

}  // namespace tera
