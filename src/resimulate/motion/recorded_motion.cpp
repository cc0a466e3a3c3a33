#include "resimulate/motion/recorded_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>

#include "physics/actuation/axes.h"

namespace tera {
namespace {

constexpr TimeNs kNear_ns = 300'000'000;  ///< a sample is valid this long before and after its time
/// A longer interval between samples, in mean periods, is a gap.
constexpr TimeNs kPeriodsOfGap = 3;
constexpr TimeNs kSmooth_ns = 25'000'000;   ///< half width of the window of an encoder's linear fit
constexpr TimeNs kRateStep_ns = 5'000'000;  ///< step for rates by finite differences

/// Angular velocity in W from the first to the second rotation.
Vec3 RateOf(const Mat3& before, const Mat3& after, double dt_s) {
  const Eigen::AngleAxisd turn(after * before.transpose());
  return turn.axis() * (turn.angle() / dt_s);
}

/// True if samples at these ordered times cover `t_ns`: it is close to a sample, or between two
/// samples without a gap.
template <typename Time>
bool Covers(std::size_t count, const Time& time_of, TimeNs t_ns) {
  if (count == 0) return false;
  const auto places = std::views::iota(std::size_t{0}, count);
  const std::size_t next = static_cast<std::size_t>(
      std::ranges::lower_bound(places, t_ns, {}, time_of) - places.begin());
  if (next == 0) return t_ns >= time_of(0) - kNear_ns;
  if (next == count) return t_ns <= time_of(count - 1) + kNear_ns;
  const TimeNs before_ns = time_of(next - 1), after_ns = time_of(next);
  const auto period_ns = (time_of(count - 1) - time_of(0)) / static_cast<TimeNs>(count - 1);
  return std::min(t_ns - before_ns, after_ns - t_ns) <= kNear_ns ||
         after_ns - before_ns <= kPeriodsOfGap * period_ns;
}

}  // namespace

double RecordedMotion::Axis::At(TimeNs t) const {
  const auto first = std::lower_bound(t_ns.begin(), t_ns.end(), t - kSmooth_ns) - t_ns.begin();
  const auto last = std::upper_bound(t_ns.begin(), t_ns.end(), t + kSmooth_ns) - t_ns.begin();
  // A least-squares line over the window. With few samples, the line through the two adjacent ones.
  if (last - first < 3) {
    const auto next = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(std::lower_bound(t_ns.begin(), t_ns.end(), t) - t_ns.begin(), 1,
                                   std::max<std::ptrdiff_t>(1, std::ssize(t_ns) - 1)));
    if (t_ns.size() == 1) return position[0];
    const double s =
        static_cast<double>(t - t_ns[next - 1]) / static_cast<double>(t_ns[next] - t_ns[next - 1]);
    return std::lerp(position[next - 1], position[next], std::clamp(s, 0.0, 1.0));
  }
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
    const double late_s = ToSeconds(t_ns[i] - t);
    n += 1;
    x += late_s;
    y += position[i];
    xx += late_s * late_s;
    xy += late_s * position[i];
  }
  return (y * xx - x * xy) / (n * xx - x * x);
}

std::optional<RecordedMotion::Axis> RecordedMotion::AxisNamed(const std::string& axis,
                                                              const std::string& machine,
                                                              const Recording& recording) {
  for (const std::string& channel : recording.ChannelsOf(kEncoderChannel)) {
    if (!channel.starts_with(machine + "/")) continue;
    const EncoderRecording encoder = recording.LoadEncoder(channel);
    for (std::size_t a = 0; a < encoder.axes.size(); ++a) {
      if (encoder.axes[a].name != axis || encoder.samples.empty()) continue;
      Axis found;
      for (const EncoderSample& sample : encoder.samples) {
        found.t_ns.push_back(sample.t_ns);
        found.position.push_back(sample.q_rad[a]);
      }
      return found;
    }
  }
  return std::nullopt;
}

RecordedMotion::RecordedMotion(const MachinePlacement& placement, const std::string& name,
                               const Recording& recording)
    : placement_(placement) {
  const MachineModel& model = placement.model;
  if (const std::string file = "truth/" + name + "/pose.csv"; recording.Has(file)) {
    poses_ = recording.LoadPose(file).poses;
  }
  if (poses_.empty() && !model.fixed_base) {
    obstacle_ = fmt::format("the recording has no poses of {}", name);
  }
  for (const Joint& joint : model.joints) {
    joints_.push_back(AxisNamed(joint.name, name, recording));
  }
  for (std::size_t j = 0; j < joints_.size(); ++j) shows_whole_ = shows_whole_ && IsShown(j);
  for (const RunningGear& gear : model.ground_tools.gears) {
    gears_.push_back(AxisNamed(gear.name, name, recording));
  }
}

bool RecordedMotion::IsShown(std::size_t joint) const {
  const MachineModel& model = placement_.model;
  const int leader = LeaderOf(model, static_cast<int>(joint));
  return joints_[joint] || joints_[leader] || model.joints[joint].type == JointType::kFixed ||
         !HasLever(model, leader);
}

std::optional<TimeNs> RecordedMotion::first_ns() const {
  std::optional<TimeNs> first;
  const auto take = [&](TimeNs t_ns) { first = std::min(first.value_or(t_ns), t_ns); };
  if (!poses_.empty()) take(poses_.front().t_ns);
  for (const std::optional<Axis>& axis : joints_) {
    if (axis) take(axis->t_ns.front());
  }
  return first;
}

bool RecordedMotion::IsKnownAt(TimeNs t_ns) const {
  if (!obstacle_.empty()) return false;
  if (!poses_.empty() && !Covers(
                             poses_.size(), [&](std::size_t i) { return poses_[i].t_ns; }, t_ns)) {
    return false;
  }
  return std::all_of(joints_.begin(), joints_.end(), [&](const std::optional<Axis>& axis) {
    return !axis || Covers(
                        axis->t_ns.size(), [&](std::size_t i) { return axis->t_ns[i]; }, t_ns);
  });
}

bool RecordedMotion::Carries(int link) const {
  const auto& joints = placement_.model.joints;
  for (std::size_t j = joints.size(); j-- > 0;) {
    if (joints[j].child != link) continue;
    if (!IsShown(j)) return false;
    link = joints[j].parent;
  }
  return true;
}

MachineState RecordedMotion::At(TimeNs t_ns) const {
  const auto pose_at = [&](TimeNs t) {
    if (poses_.empty()) return placement_.X_WB;
    const auto next = std::lower_bound(poses_.begin(), poses_.end(), t,
                                       [](const TruthPose& p, TimeNs at) { return p.t_ns < at; });
    if (next == poses_.begin()) return poses_.front().X_WB;
    if (next == poses_.end()) return poses_.back().X_WB;
    const TruthPose &a = *(next - 1), &b = *next;
    return Interpolate(a.X_WB, b.X_WB,
                       static_cast<double>(t - a.t_ns) / static_cast<double>(b.t_ns - a.t_ns));
  };
  const auto positions_at = [&](TimeNs t) {
    std::vector<double> q_rad = placement_.q_rad;
    for (std::size_t j = 0; j < q_rad.size(); ++j) {
      if (joints_[j]) q_rad[j] = joints_[j]->At(t);
    }
    for (std::size_t j = 0; j < q_rad.size(); ++j) {
      const auto& following = placement_.model.joints[j].following;
      if (following && !joints_[j]) q_rad[j] = following->At(q_rad[following->leader]);
    }
    return q_rad;
  };
  const double dt_s = ToSeconds(2 * kRateStep_ns);
  const MachineModel& model = placement_.model;
  MachineState state;
  state.q_rad = positions_at(t_ns);
  const std::vector<double> before_rad = positions_at(t_ns - kRateStep_ns),
                            after_rad = positions_at(t_ns + kRateStep_ns);
  for (std::size_t j = 0; j < state.q_rad.size(); ++j) {
    state.qd_radps.push_back((after_rad[j] - before_rad[j]) / dt_s);
  }
  const std::vector<Pose> now = ForwardKinematics(model, pose_at(t_ns), state.q_rad);
  const auto before = ForwardKinematics(model, pose_at(t_ns - kRateStep_ns), before_rad);
  const auto after = ForwardKinematics(model, pose_at(t_ns + kRateStep_ns), after_rad);
  for (std::size_t l = 0; l < now.size(); ++l) {
    BodyState body;
    body.X_WB = now[l];
    body.v_WB_mps = (after[l].translation() - before[l].translation()) / dt_s;
    body.w_WB_radps = RateOf(before[l].linear(), after[l].linear(), dt_s);
    state.links.push_back(body);
  }
  for (const std::optional<Axis>& gear : gears_) {
    state.gear_angle_rad.push_back(gear ? gear->At(t_ns) : 0);
    state.gear_rate_radps.push_back(
        gear ? (gear->At(t_ns + kRateStep_ns) - gear->At(t_ns - kRateStep_ns)) / dt_s : 0);
  }
  return state;
}

}  // namespace tera
