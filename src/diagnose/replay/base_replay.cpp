#include "diagnose/replay/base_replay.h"

#include "physics/track_drive.h"

namespace tera {

std::vector<PlanarTwist> BaseReplay::Predict(const Effects& base) const {
  MachineModel model = model_;
  model.effects.base = base;
  SetShoeRatios(&model);
  const TrackDrive tracks(model);
  MachineState state;
  state.links.resize(model.links.size());
  std::vector<PlanarTwist> twists;
  for (const BaseInterval& interval : log_.intervals) {
    PlanarTwist sum;
    for (std::size_t i = interval.first; i < interval.first + interval.count; ++i) {
      state.gear_rate_radps = log_.instants[i].gear_rate_radps;
      state.links[0].X_WB.linear() = log_.instants[i].R_WB;
      const PlanarTwist twist = tracks.Follow(state, {}).twist;
      sum.forward_mps += twist.forward_mps;
      sum.left_mps += twist.left_mps;
      sum.yaw_radps += twist.yaw_radps;
    }
    const auto n = static_cast<double>(interval.count);
    twists.push_back({sum.forward_mps / n, sum.left_mps / n, sum.yaw_radps / n});
  }
  return twists;
}

}  // namespace tera
