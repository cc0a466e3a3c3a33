#include "resimulate/recorded_stage.h"

#include <algorithm>
#include <cmath>

namespace tera {

RecordedStage::RecordedStage(Scenario* scenario, const std::vector<RecordedMotion>& machines,
                             TimeNs start_ns)
    : scenario_(scenario),
      machines_(machines),
      start_ns_(start_ns),
      clock_{.rate_hz = scenario->physics_rate_hz, .start_ns = start_ns},
      step_(-std::llround(scenario->settle_s * scenario->physics_rate_hz)) {
  for (const ScenarioMachine& machine : scenario->machines) {
    soil_handle_.push_back(scenario->soil->AddMachine(machine.placement.model.ground_tools));
    now_.loads.emplace_back(machine.placement.model.ground_tools.shovels.size());
  }
  for (const ScenarioObstacle& obstacle : scenario->obstacles) {
    bed_handle_.emplace_back();
    if (obstacle.bed) bed_handle_.back() = scenario->soil->AddBed(*obstacle.bed);
  }
}

RecordedStage::Moment RecordedStage::AdvanceTo(TimeNs t_ns) {
  const double dt_s = 1.0 / scenario_->physics_rate_hz;
  for (; clock_.Due(step_) < t_ns; ++step_) {
    const TimeNs now_ns = clock_.Due(step_);
    for (std::size_t o = 0; o < bed_handle_.size(); ++o) {
      if (!bed_handle_[o]) continue;
      const BodyState body = ObstacleAt(scenario_->obstacles[o], now_ns, ground());
      scenario_->soil->MoveBed(*bed_handle_[o], body.X_WB);
    }
    for (std::size_t m = 0; m < machines_.size(); ++m) {
      if (!machines_[m].IsKnownAt(std::max(now_ns, start_ns_))) continue;
      // Before the first time the machines stand where they then are.
      MachineState state = machines_[m].At(std::max(now_ns, start_ns_));
      if (now_ns < start_ns_) {
        for (BodyState& link : state.links) {
          link.v_WB_mps.setZero();
          link.w_WB_radps.setZero();
        }
        state.gear_rate_radps.assign(state.gear_rate_radps.size(), 0.0);
      }
      const GroundToolsMotion motion{&state.links, state.gear_rate_radps};
      now_.loads[m] = scenario_->soil->Act(soil_handle_[m], motion, dt_s).shovel_load;
    }
    scenario_->soil->Flow(dt_s);
  }
  if (const std::uint64_t version = GroundVersion(); !now_.ground || version != version_) {
    now_.ground = std::make_shared<const TerrainSurface>(ground());
    version_ = version;
  }
  return now_;
}

std::uint64_t RecordedStage::GroundVersion() const {
  const TerrainSurface& surface = ground();
  std::uint64_t sum = surface.grains().empty() ? 0 : 1 + static_cast<std::uint64_t>(step_);
  for (int b = 0; b < surface.tiles_y(); ++b) {
    for (int a = 0; a < surface.tiles_x(); ++a) sum += surface.tile_version(a, b);
  }
  return sum;
}

WorldState RecordedStage::StateAt(TimeNs t_ns, const Moment& moment) const {
  WorldState state;
  state.t_ns = t_ns;
  for (std::size_t m = 0; m < machines_.size(); ++m) {
    state.machines.push_back(machines_[m].At(t_ns));
    state.machines.back().shovel_load = moment.loads[m];
  }
  for (const ScenarioObstacle& obstacle : scenario_->obstacles) {
    state.obstacles.push_back(ObstacleAt(obstacle, t_ns, *moment.ground));
  }
  return state;
}

}  // namespace tera
