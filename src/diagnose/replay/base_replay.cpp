#include "diagnose/replay/base_replay.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/check.h"
#include "core/units.h"
#include "physics/traction/track_drive.h"

namespace tera {
namespace {

using Way = Eigen::Vector3d;  ///< displacement: forward (m), left (m), yaw (rad)

/// A mass that friction under its two sides accelerates.
class MassOnTracks {
 public:
  MassOnTracks(const TrackGeometry& geometry, const Grip& grip, const PlanarTwist& at_first)
      : gauge_m_(geometry.gauge_m),
        mass_kg_(geometry.weight_n / kStandardGravity_mps2),
        inertia_kgm2_(grip.yaw_inertia_kgm2),
        most_of_side_n_(0.5 * grip.friction * geometry.weight_n),
        twist_(at_first) {
    TERA_CHECK(inertia_kgm2_ > 0 && gauge_m_ > 0, inertia_kgm2_, gauge_m_);
  }

  /// Twist after a step in which the tracks would give `target`.
  PlanarTwist Follow(const PlanarTwist& target, double dt_s) {
    const double forward_n = mass_kg_ * (target.forward_mps - twist_.forward_mps) / dt_s;
    const double yaw_nm = inertia_kgm2_ * (target.yaw_radps - twist_.yaw_radps) / dt_s;
    const auto side_n = [&](double sign) {
      return std::clamp(0.5 * forward_n + sign * yaw_nm / gauge_m_, -most_of_side_n_,
                        most_of_side_n_);
    };
    const double left_n = side_n(-1), right_n = side_n(1);
    twist_.forward_mps += (left_n + right_n) / mass_kg_ * dt_s;
    twist_.yaw_radps += 0.5 * gauge_m_ * (right_n - left_n) / inertia_kgm2_ * dt_s;
    twist_.left_mps = target.left_mps;
    return twist_;
  }

 private:
  double gauge_m_, mass_kg_, inertia_kgm2_, most_of_side_n_;
  PlanarTwist twist_;
};

/// Displacement from the log's start to the start of each step, and to the end of the last step.
std::vector<Way> WaysOf(const TrackDrive& tracks, const BaseLog& log, MachineState state,
                        const std::optional<Grip>& grip) {
  const double dt_s = ToSeconds(BaseLog::kStep_ns);
  std::optional<MassOnTracks> mass;
  if (grip) mass.emplace(tracks.geometry(), *grip, log.intervals.front().twist);
  std::vector<Way> ways = {Way::Zero()};
  for (const BaseInstant& instant : log.instants) {
    state.gear_rate_radps = instant.gear_rate_radps;
    state.links[0].X_WB.linear() = instant.R_WB;
    PlanarTwist twist = tracks.Follow(state, {}).twist;
    if (mass) twist = mass->Follow(twist, dt_s);
    ways.push_back(ways.back() + dt_s * Way(twist.forward_mps, twist.left_mps, twist.yaw_radps));
  }
  return ways;
}

/// Displacement at a time, given in steps. Extrapolates beyond the first and last step.
Way WayAt(const std::vector<Way>& ways, double steps) {
  const double k = std::clamp(std::floor(steps), 0.0, static_cast<double>(ways.size() - 2));
  const auto step = static_cast<std::size_t>(k);
  return ways[step] + (steps - k) * (ways[step + 1] - ways[step]);
}

}  // namespace

std::vector<PlanarTwist> BaseReplay::Predict(const Effects& base, const PoseStamps& stamps,
                                             const std::optional<Grip>& grip) const {
  MachineModel model = model_;
  model.effects.base = base;
  SetShoeRatios(&model);
  MachineState state;
  state.links.resize(model.links.size());
  const std::vector<Way> ways = WaysOf(TrackDrive(model), log_, std::move(state), grip);
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
