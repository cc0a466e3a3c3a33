#include "resimulate/motion/recorded_machines.h"

#include <algorithm>

#include "core/check.h"

namespace tera {

void RecordedMachines::Start(const Begin& begin, WorldState* world) {
  TERA_CHECK(motions_.size() == scenario_.machines.size(), motions_.size());
  start_ns_ = begin.start_ns;
  now_ns_ = begin.start_ns - 1;  // at rest until the start
  for (std::size_t m = 0; m < motions_.size(); ++m) {
    world->machines.push_back(StateAt(m, now_ns_));
    world->machines[m].shovel_load.resize(
        scenario_.machines[m].placement.model.ground_tools.shovels.size());
  }
}

void RecordedMachines::Move(const Step& step, WorldState* world) {
  now_ns_ = step.to_ns;
  for (std::size_t m = 0; m < motions_.size(); ++m) {
    const bool is_loaded = !step.reactions[m].shovel_load.empty();
    const auto load = is_loaded ? step.reactions[m].shovel_load : world->machines[m].shovel_load;
    world->machines[m] = StateAt(m, now_ns_);
    world->machines[m].shovel_load = load;
  }
}

bool RecordedMachines::IsKnown(std::size_t machine) const {
  return motions_[machine].IsKnownAt(std::max(now_ns_, start_ns_));
}

MachineState RecordedMachines::StateAt(std::size_t machine, TimeNs t_ns) const {
  MachineState state = motions_[machine].At(std::max(t_ns, start_ns_));
  if (t_ns >= start_ns_) return state;
  for (BodyState& link : state.links) {
    link.v_WB_mps.setZero();
    link.w_WB_radps.setZero();
  }
  state.gear_rate_radps.assign(state.gear_rate_radps.size(), 0.0);
  return state;
}

}  // namespace tera
