#include "dig_site.h"

#include <algorithm>

#include "core/check.h"

namespace tera::bench {
namespace {

// The first cut of the quickstart, teeth in the ground.
constexpr double kStart_s = 2.0, kPeriod_s = 0.1;
constexpr int kInstants = 10;

}  // namespace

ShippedScenario LoadWith(const std::string& name, const std::vector<std::string>& overrides) {
  const Config config =
      Config::FromFile(DataRoot() / "config/scenarios" / (name + ".yaml"), overrides);
  ShippedScenario loaded{ReadScenario(config.root()), {}};
  config.Finish();
  loaded.resolved_yaml = config.ResolvedYaml();
  return loaded;
}

ShippedScenario Load(const std::string& name,
                     const std::function<bool(const SensorDescription&)>& keep) {
  ShippedScenario loaded = LoadWith(name, {});
  for (ScenarioMachine& machine : loaded.scenario.machines) {
    std::erase_if(machine.sensors, [&](const SensorDescription& s) { return !keep(s); });
  }
  return loaded;
}

ShippedScenario Load(const std::string& name) { return LoadWith(name, {}); }

DigSite::DigSite() : scenario_(Load("quickstart").scenario), assembly_(scenario_) {
  for (std::size_t m = 0; m < scenario_.machines.size(); ++m) {
    for (const SensorDescription& sensor : scenario_.machines[m].sensors) {
      sensors_.push_back(sensor);
      machine_of_sensor_.push_back(m);
    }
  }
  Simulation simulation(scenario_);
  instants_.reserve(kInstants);  // each scene points at the ground beside it
  while (static_cast<int>(instants_.size()) < kInstants) {
    simulation.Step();
    const double next_s = kStart_s + kPeriod_s * static_cast<double>(instants_.size());
    if (simulation.state().t_ns >= FromSeconds(next_s)) Remember(simulation);
  }
}

void DigSite::Remember(const Simulation& simulation) {
  const WorldState& state = simulation.state();
  Instant& instant = instants_.emplace_back();
  instant.ground = simulation.ground();
  instant.scene = {state.t_ns, assembly_.BodyPoses(state), &instant.ground,
                   assembly_.ShapesOf(state)};
  for (std::size_t s = 0; s < sensors_.size(); ++s) {
    const std::size_t m = machine_of_sensor_[s];
    const int link = scenario_.machines[m].placement.model.LinkIndex(sensors_[s].link);
    instant.X_WS.push_back(link < 0 ? Pose::Identity()
                                    : state.machines[m].links[link].X_WB * sensors_[s].X_BS);
  }
}

std::size_t DigSite::IndexOf(const std::string& sensor) const {
  const auto found = std::find_if(sensors_.begin(), sensors_.end(),
                                  [&](const SensorDescription& s) { return s.name == sensor; });
  TERA_CHECK(found != sensors_.end(), sensor);
  return static_cast<std::size_t>(found - sensors_.begin());
}

const DigSite& TheDigSite() {
  static const DigSite site;
  return site;
}

}  // namespace tera::bench
