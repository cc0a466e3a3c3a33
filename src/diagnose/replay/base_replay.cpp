#include "diagnose/replay/base_replay.h"

#include <algorithm>
#include <cmath>

#include "physics/track_drive.h"

namespace tera {
namespace {

using Way = Eigen::Vector3d;  ///< forward, left, turn

/// How far the base has come by the begin of each step, and by the end of the last one.
std::vector<Way> WaysOf(const TrackDrive& tracks, const BaseLog& log, MachineState state) {
  std::vector<Way> ways = {Way::Zero()};
  for (const BaseInstant& instant : log.instants) {
    state.gear_rate_radps = instant.gear_rate_radps;
    state.links[0].X_WB.linear() = instant.R_WB;
    const PlanarTwist twist = tracks.Follow(state, {}).twist;
    ways.push_back(ways.back() + ToSeconds(BaseLog::kStep_ns) *
                                     Way(twist.forward_mps, twist.left_mps, twist.yaw_radps));
  }
  return ways;
}

/// Beyond the first step and the last one it goes on as in these.
Way WayAt(const std::vector<Way>& ways, double steps) {
  const double k = std::clamp(std::floor(steps), 0.0, static_cast<double>(ways.size() - 2));
  const auto step = static_cast<std::size_t>(k);
  return ways[step] + (steps - k) * (ways[step + 1] - ways[step]);
}

}  // namespace

std::vector<PlanarTwist> BaseReplay::Predict(const Effects& base, const PoseStamps& stamps) const {
  MachineModel model = model_;
  model.effects.base = base;
  SetShoeRatios(&model);
  MachineState state;
  state.links.resize(model.links.size());
  const std::vector<Way> ways = WaysOf(TrackDrive(model), log_, std::move(state));
  const auto way_at = [&](TimeNs t_ns) {
    return WayAt(ways,
                 (ToSeconds(t_ns - log_.start_ns) - stamps.late_s) / ToSeconds(BaseLog::kStep_ns));
  };
  std::vector<PlanarTwist> twists;
  for (const BaseInterval& interval : log_.intervals) {
    const Way way = stamps.of_arrival
                        ? Way(way_at(interval.measured_to_ns) - way_at(interval.measured_from_ns))
                        : Way(way_at(interval.to_ns) - way_at(interval.from_ns));
    const double dt_s = ToSeconds(interval.to_ns - interval.from_ns);
    twists.push_back({way[0] / dt_s, way[1] / dt_s, way[2] / dt_s});
  }
  return twists;
}

}  // namespace tera
