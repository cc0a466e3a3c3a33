#include "recorded_motion.h"

#include "dig_site.h"
#include "sim/simulation.h"

namespace tera::bench {

RecordedMotion Record(const std::string& scenario, int steps) {
  ShippedScenario loaded = Load(scenario);
  Simulation simulation(loaded.scenario);
  RecordedMotion motion;
  motion.dt_s = 1.0 / loaded.scenario.physics_rate_hz;
  for (int step = 0; step < steps; ++step) {
    const MachineState& machine = simulation.state().machines.front();
    motion.moments.push_back({machine.links, machine.gear_rate_radps});
    simulation.Step();
  }
  return motion;
}

}  // namespace tera::bench
