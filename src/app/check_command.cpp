#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "app/arguments/argument_checks.h"
#include "app/arguments/scenario_options.h"
#include "app/commands.h"
#include "core/error.h"
#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/png.h"
#include "sim/machine_doubts.h"
#include "sim/run/episode_sheet.h"
#include "sim/scene_assembly.h"

namespace tera {
namespace {

/// Rounds to tenths of a degree. The sum turns -0 into 0.
double Tenths(double angle_deg) { return std::round(10 * angle_deg) / 10 + 0.0; }

/// Mass text; from 100 kg on, in whole kilograms.
std::string ShownMass(double mass_kg) {
  return mass_kg < 100 ? fmt::format("{:.3g}", mass_kg) : fmt::format("{:.0f}", mass_kg);
}

void PrintMachine(const ScenarioMachine& machine) {
  const MachineModel& model = machine.placement.model;
  const Vec3 p = machine.placement.X_WB.translation();
  fmt::print(
      "\nmachine {} ({}): {} links, {} joints, {} levers, {} kg, at ({:.2f}, {:.2f}, {:.2f}) "
      "m\n",
      machine.placement.name, model.kind, model.links.size(), model.joints.size(),
      model.levers.size(), ShownMass(model.TotalMass_kg()), p.x(), p.y(), p.z());
  std::vector<std::string> levers;
  for (const Lever& lever : model.levers) levers.push_back(lever.name);
  if (!levers.empty()) fmt::print("  levers: {}\n", fmt::join(levers, ", "));
  fmt::print("  {:<18} {:<12} {:<14} {:>22} {:>22} {:>9}\n", "sensor", "type", "link", "xyz m",
             "rpy deg", "rate Hz");
  for (const SensorDescription& sensor : machine.sensors) {
    const Vec3 xyz = sensor.X_BS.translation();
    const Vec3 rpy = RpyFromRotation(sensor.X_BS.linear()) / kDeg;
    fmt::print(
        "  {:<18} {:<12} {:<14} {:>22} {:>22} {:>9g}\n", sensor.name, TypeOf(sensor),
        sensor.link.empty() ? "-" : sensor.link,
        fmt::format("{:.3f} {:.3f} {:.3f}", xyz.x(), xyz.y(), xyz.z()),
        fmt::format("{:.1f} {:.1f} {:.1f}", Tenths(rpy.x()), Tenths(rpy.y()), Tenths(rpy.z())),
        sensor.clock.rate_hz);
  }
}

/// Prints mass and size of each link, and the remarks of the machine file's reader.
void PrintLinks(const ScenarioMachine& machine, const SceneModel& scene) {
  fmt::print("  {:<24} {:>10}  {}\n", "link", "mass kg", "size m");
  for (const LinkSize& link : SizesOf(machine, scene)) {
    const Vec3& size_m = link.size_m;
    fmt::print("  {:<24} {:>10.4g}  {}\n", link.name, link.mass_kg,
               size_m.isZero(0)
                   ? "-"
                   : fmt::format("{:.4g} x {:.4g} x {:.4g}", size_m.x(), size_m.y(), size_m.z()));
  }
  for (const std::string& remark : machine.placement.model.remarks) fmt::print("{}\n", remark);
}

void PrintDoubts(const ScenarioMachine& machine, const SceneModel& scene) {
  for (const std::string& doubt : DoubtsOf(machine, scene)) {
    fmt::print("warning: {}\n", doubt);
  }
}

constexpr int kMostTiles = 400;

/// Loads each episode, prints its draws and calls `visit`.
template <typename Visit>
void ForEpisodes(ScenarioOptions options, int count, const Visit& visit) {
  for (int episode = 0; episode < count; ++episode) {
    options.episode = static_cast<std::uint64_t>(episode);
    const LoadedScenario loaded = Load(options);
    const SceneAssembly every_mesh_loads(loaded.scenario);
    fmt::print("\nepisode {}:\n", episode);
    for (const std::string& value : loaded.scenario.drawn) fmt::print("  {}\n", value);
    if (loaded.scenario.drawn.empty()) fmt::print("  nothing is drawn\n");
    visit(loaded.scenario);
  }
}

/// Renders all episodes to one contact sheet.
void WriteSheet(const ScenarioOptions& options, int count, const std::string& file) {
  PreparePng();
  EpisodeSheet sheet;
  ForEpisodes(options, count, [&](const Scenario& scenario) { sheet.Add(scenario, {}); });
  WriteWholeFile(file, EncodeRgbPng(sheet.Draw()));
  fmt::print("\n{}: {} episodes\n", file, count);
}

void RunCheck(const ScenarioOptions& options) {
  const LoadedScenario loaded = Load(options);
  const Scenario& scenario = loaded.scenario;
  const SceneAssembly assembly(scenario);
  const TerrainSurface& ground = scenario.site->surface();
  fmt::print("{}: {} s at {} Hz, seed {}\n", scenario.name, scenario.duration_s,
             scenario.physics_rate_hz, scenario.seed);
  fmt::print("site: {:.1f} x {:.1f} m at {} m, origin {:.7f} {:.7f} deg, {:.2f} m; {} soils\n",
             (ground.nx - 1) * ground.cell_m, (ground.ny - 1) * ground.cell_m, ground.cell_m,
             scenario.origin.lat_deg, scenario.origin.lon_deg, scenario.origin.height_m,
             scenario.site->soils().size());
  for (const ScenarioMachine& machine : scenario.machines) {
    PrintMachine(machine);
    PrintLinks(machine, assembly.model());
  }
  for (const ScenarioObstacle& obstacle : scenario.obstacles) {
    fmt::print("{} {} at ({:.2f}, {:.2f}) m{}\n", NameOf(obstacle.label), obstacle.name,
               obstacle.xy_W_m.x(), obstacle.xy_W_m.y(),
               obstacle.dynamic        ? ", dynamic"
               : obstacle.path.empty() ? ""
                                       : ", moving");
  }
  for (const ScenarioMachine& machine : scenario.machines) {
    PrintDoubts(machine, assembly.model());
  }
  for (const std::string& doubt : PlacesInDoubt(scenario)) fmt::print("warning: {}\n", doubt);
  fmt::print("valid\n");
}

}  // namespace

void AddCheckCommand(CLI::App* app) {
  struct Arguments {
    ScenarioOptions scenario;
    int sample = 0;
    std::string sheet;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app->add_subcommand("check", "Validate a scenario and all it names, without running it");
  AddScenarioOptions(command, &arguments->scenario);
  command
      ->add_option("--sample", arguments->sample,
                   "Draw and read as many episodes of the scenario's randomise:")
      ->check(WholeNumberBetween(1, 10000));
  command->add_option("--sheet", arguments->sheet,
                      "Picture (PNG) to write of the first instant of those episodes");
  command->callback([arguments] {
    if (arguments->sheet.empty()) {
      if (arguments->sample == 0) return RunCheck(arguments->scenario);
      ForEpisodes(arguments->scenario, arguments->sample, [](const Scenario&) {});
    } else {
      if (arguments->sample == 0 || arguments->sample > kMostTiles) {
        throw InputError("--sheet", {FaultKind::kOutOfRange,
                                     fmt::format("{} episodes to draw; need --sample 1 to {}",
                                                 arguments->sample, kMostTiles)});
      }
      WriteSheet(arguments->scenario, arguments->sample, arguments->sheet);
    }
    fmt::print("\nvalid\n");
  });
}

}  // namespace tera
