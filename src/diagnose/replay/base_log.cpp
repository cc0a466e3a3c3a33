#include "diagnose/replay/base_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "physics/traction/track_drive.h"
#include "physics/traction/turning_centre.h"

namespace tera {
namespace {

constexpr double kLongestInterval_s = 1;  ///< poses further apart bound no interval

/// Comparison of angles with rates: length of a window, and largest RMS difference relative to the
/// RMS rate.
constexpr double kAngleWindow_s = 1, kMostAngleError = 0.1;

/// The rate and angle of one gear over time.
struct GearSamples : AxisSamples {
  bool angle_is_of_rate = false;

  /// Mean rate of a step about a time. The angles at its ends are used if they agree with the
  /// rates, because angles are measured far better.
  double MeanRate_radps(TimeNs middle_ns, TimeNs step_ns) const {
    const TimeNs from_ns = std::max(middle_ns - step_ns / 2, t_ns.front());
    const TimeNs to_ns = std::min(middle_ns + step_ns / 2, t_ns.back());
    if (!angle_is_of_rate || to_ns <= from_ns) {
      return BetweenSamples(t_ns, middle_ns).Of(rate_radps);
    }
    const double turned_rad = BetweenSamples(t_ns, to_ns).Of(position_rad) -
                              BetweenSamples(t_ns, from_ns).Of(position_rad);
    return turned_rad / ToSeconds(to_ns - from_ns);
  }
};

/// True if a gear's angle agrees with the integral of its rate over windows of a second. An angle
/// that wraps, belongs to a motor or is missing does not agree.
bool AngleIsOfRate(const GearSamples& gear) {
  double since_s = 0, apart_rad = 0, squares = 0, rates = 0, windows = 0;
  for (std::size_t k = 1; k < gear.t_ns.size(); ++k) {
    const double dt_s = ToSeconds(gear.t_ns[k] - gear.t_ns[k - 1]);
    const double mean_radps = 0.5 * (gear.rate_radps[k] + gear.rate_radps[k - 1]);
    apart_rad += gear.position_rad[k] - gear.position_rad[k - 1] - dt_s * mean_radps;
    rates += dt_s * mean_radps * mean_radps;
    since_s += dt_s;
    if (since_s < kAngleWindow_s) continue;
    squares += apart_rad * apart_rad / since_s;
    windows += since_s;
    since_s = apart_rad = 0;
  }
  return windows > 0 && squares <= kMostAngleError * kMostAngleError * rates;
}

/// Common time of all gears and poses; the end precedes the start if there is none.
struct CommonTime {
  TimeNs first_ns = 0, last_ns = -1;
};

CommonTime CommonTimeOf(const std::vector<GearSamples>& gears,
                        const std::vector<TruthPose>& poses) {
  if (poses.empty()) return {};
  CommonTime common{poses.front().t_ns, poses.back().t_ns};
  for (const GearSamples& gear : gears) {
    common.first_ns = std::max(common.first_ns, gear.t_ns.front());
    common.last_ns = std::min(common.last_ns, gear.t_ns.back());
  }
  return common;
}

std::vector<GearSamples> GearsOf(const MachineModel& model,
                                 const std::vector<NamedEncoders>& encoders) {
  std::vector<GearSamples> gears;
  for (const RunningGear& gear : model.ground_tools.gears) {
    auto found = SamplesOf(gear.name, encoders);
    if (!found) {
      throw InputError(
          fmt::format("no encoder measures {}; a replay of the base needs every gear", gear.name));
    }
    gears.push_back({std::move(*found)});
    gears.back().angle_is_of_rate = AngleIsOfRate(gears.back());
  }
  return gears;
}

double Yaw_rad(const Mat3& R) { return std::atan2(R(1, 0), R(0, 0)); }

PlanarTwist MeanTwist(const Pose& X_WA, const Pose& X_WB, const Vec3& contact_B_m, double dt_s) {
  const double from_rad = Yaw_rad(X_WA.linear());
  const double turned_rad = std::remainder(Yaw_rad(X_WB.linear()) - from_rad, 2 * kPi);
  const double heading_rad = from_rad + 0.5 * turned_rad;
  const Vec3 moved_W_m = X_WB * contact_B_m - X_WA * contact_B_m;
  const Vec3 forward_W = X_WA.linear().col(0) + X_WB.linear().col(0);
  const Vec3 along_W =
      Vec3(std::cos(heading_rad), std::sin(heading_rad), forward_W.z() / forward_W.head<2>().norm())
          .normalized();
  const Vec3 left_W(-std::sin(heading_rad), std::cos(heading_rad), 0);
  // An arc is longer than its chord.
  const double arc = turned_rad == 0 ? 1 : 0.5 * turned_rad / std::sin(0.5 * turned_rad);
  return {arc * moved_W_m.dot(along_W) / dt_s, arc * moved_W_m.dot(left_W) / dt_s,
          turned_rad / dt_s};
}

/// Joint positions over time. A joint without an encoder keeps its initial position.
class JointPositions {
 public:
  JointPositions(const MachineModel& model, const std::vector<NamedEncoders>& encoders) {
    for (const Joint& joint : model.joints) at_first_rad_.push_back(joint.initial_rad);
    for (const auto& [channel, recording] : encoders) {
      for (std::size_t i = 0; i < recording.axes.size(); ++i) {
        const int j = model.JointIndex(recording.axes[i].name);
        if (j < 0 || recording.samples.empty()) continue;
        measured_.emplace_back(static_cast<std::size_t>(j), SamplesOf(recording, i));
      }
    }
  }
  std::vector<double> At(TimeNs t_ns) const {
    std::vector<double> q_rad = at_first_rad_;
    for (const auto& [joint, samples] : measured_) {
      const double q = BetweenSamples(samples.t_ns, t_ns).Of(samples.position_rad);
      if (std::isfinite(q)) q_rad[joint] = q;
    }
    return q_rad;
  }

 private:
  std::vector<double> at_first_rad_;
  std::vector<std::pair<std::size_t, AxisSamples>> measured_;  ///< by joint
};

/// Adds the instants from `first_ns` to `last_ns`.
void AddInstants(const MachineModel& model, const JointPositions& joints,
                 const std::vector<GearSamples>& gears, const std::vector<TruthPose>& poses,
                 const Vec3& contact_B_m, TimeNs first_ns, TimeNs last_ns, BaseLog* log) {
  log->start_ns = first_ns;
  std::size_t pose = 0;
  for (TimeNs t_ns = first_ns + BaseLog::kStep_ns / 2; t_ns < last_ns + BaseLog::kStep_ns / 2;
       t_ns += BaseLog::kStep_ns) {
    while (pose + 1 < poses.size() &&
           std::abs(poses[pose + 1].t_ns - t_ns) <= std::abs(poses[pose].t_ns - t_ns)) {
      ++pose;
    }
    BaseInstant instant;
    for (const GearSamples& gear : gears) {
      instant.gear_rate_radps.push_back(gear.MeanRate_radps(t_ns, BaseLog::kStep_ns));
    }
    instant.R_WB = poses[pose].X_WB.linear();
    instant.turning_centre_m = TurningCentre_m(model, contact_B_m, joints.At(t_ns));
    log->instants.push_back(std::move(instant));
  }
}

BaseInterval IntervalOf(const std::vector<TruthPose>& poses, std::size_t a, std::size_t b,
                        const std::optional<PoseTimes>& arrivals, const Vec3& contact_B_m,
                        const BaseLog& log) {
  const TruthPose &from = poses[a], &to = poses[b];
  BaseInterval interval{from.t_ns, to.t_ns, from.t_ns, to.t_ns};
  if (arrivals) {
    interval.measured_from_ns = arrivals->at(a);
    interval.measured_to_ns = arrivals->at(b);
  }
  interval.twist = MeanTwist(from.X_WB, to.X_WB, contact_B_m, ToSeconds(to.t_ns - from.t_ns));
  const auto step_at = [&](TimeNs t_ns) {
    const auto step = static_cast<std::size_t>(
        std::lround(ToSeconds(t_ns - log.start_ns) / ToSeconds(BaseLog::kStep_ns)));
    return std::min(step, log.instants.size() - 1);
  };
  interval.first = step_at(from.t_ns);
  interval.count = std::max<std::size_t>(1, step_at(to.t_ns) - interval.first);
  return interval;
}

}  // namespace

bool HaveCommonTime(const MachineModel& model, const std::vector<NamedEncoders>& encoders,
                    const std::vector<TruthPose>& poses) {
  const auto [first_ns, last_ns] = CommonTimeOf(GearsOf(model, encoders), poses);
  return first_ns < last_ns;
}

BaseLog MakeBaseLog(const MachineModel& model, const std::vector<NamedEncoders>& encoders,
                    const std::vector<TruthPose>& poses, double interval_s,
                    const std::optional<PoseTimes>& arrivals) {
  const std::vector<GearSamples> gears = GearsOf(model, encoders);
  const auto [first_ns, last_ns] = CommonTimeOf(gears, poses);
  if (first_ns >= last_ns) {
    throw InputError(
        "gears and poses have no time in common; need clocks that count from the same "
        "event (`time` of the import)");
  }
  const Vec3 contact_B_m = TrackDrive(model).contact_B_m();
  BaseLog log;
  log.may_be_arrivals = arrivals.has_value();
  AddInstants(model, JointPositions(model, encoders), gears, poses, contact_B_m, first_ns, last_ns,
              &log);
  std::optional<std::size_t> from;
  for (std::size_t to = 0; to < poses.size(); ++to) {
    if (poses[to].t_ns < first_ns || poses[to].t_ns > last_ns) continue;
    const double apart_s = from ? ToSeconds(poses[to].t_ns - poses[*from].t_ns) : 0;
    if (from && apart_s < interval_s) continue;
    if (from && apart_s <= kLongestInterval_s) {
      log.intervals.push_back(IntervalOf(poses, *from, to, arrivals, contact_B_m, log));
    }
    from = to;
  }
  return log;
}

}  // namespace tera
