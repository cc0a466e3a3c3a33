#include "resimulate/recorded_stage.h"

#include "resimulate/motion/recorded_machines.h"

namespace tera {

RecordedStage::RecordedStage(const Scenario& scenario, const std::vector<RecordedMotion>& machines,
                             TimeNs start_ns)
    : scenario_(scenario),
      machines_(machines),
      simulation_(scenario, std::make_unique<RecordedMachines>(scenario, machines), start_ns) {}

RecordedStage::Moment RecordedStage::AdvanceTo(TimeNs t_ns) {
  while (simulation_.state().t_ns < t_ns) simulation_.Step();
  if (const std::uint64_t version = GroundVersion(); !now_.ground || version != version_) {
    now_.ground = std::make_shared<const TerrainSurface>(simulation_.ground());
    version_ = version;
  }
  now_.loads.clear();
  for (const MachineState& machine : simulation_.state().machines) {
    now_.loads.push_back(machine.shovel_load);
  }
  return now_;
}

std::uint64_t RecordedStage::GroundVersion() const {
  const TerrainSurface& surface = simulation_.ground();
  std::uint64_t sum =
      surface.grains().empty() ? 0 : 1 + static_cast<std::uint64_t>(simulation_.state().t_ns);
  for (int b = 0; b < surface.tiles_y(); ++b) {
    for (int a = 0; a < surface.tiles_x(); ++a) sum += surface.tile_version(a, b);
  }
  return sum;
}

Instant RecordedStage::StateAt(TimeNs t_ns, const Moment& moment) const {
  Instant state;
  state.t_ns = t_ns;
  for (std::size_t m = 0; m < machines_.size(); ++m) {
    state.machines.push_back(machines_[m].At(t_ns));
    state.machines.back().shovel_load = moment.loads[m];
  }
  for (const ScenarioObstacle& obstacle : scenario_.obstacles) {
    state.obstacles.push_back(ObstacleAt(obstacle, t_ns, *moment.ground));
  }
  return state;
}

}  // namespace tera
