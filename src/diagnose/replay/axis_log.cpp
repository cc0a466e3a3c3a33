#include "diagnose/replay/axis_log.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/error.h"
#include "physics/actuation/axes.h"
#include "physics/dynamics/gravity_load.h"
#include "physics/dynamics/joint_inertia.h"

namespace tera {
namespace {

constexpr double kLoadPeriod_s = 0.02;  ///< poses, and thus loads, change little in this time
constexpr double kLongest_s = 86400;    ///< limit on a recording: no machine works for a day
/// Distance to an end stop at which the stop may hold a joint.
constexpr double kAtStop_rad = 0.01;
constexpr double kPush = 0.02;        ///< least lever that counts as pushed: the expected dead band
constexpr double kLongestPush_s = 2;  ///< a released lever may still act for this time

/// Whether each sample of an axis is clear of its end stops.
std::vector<bool> BetweenStops(const MachineModel& model, std::size_t axis,
                               const std::vector<double>& position_rad) {
  std::vector<bool> is_free;
  for (const double q : position_rad) {
    const bool has_stops = axis < model.joints.size() &&
                           model.joints[axis].lower_rad < model.joints[axis].upper_rad &&
                           model.joints[axis].type != JointType::kContinuous;
    is_free.push_back(!has_stops || (q > model.joints[axis].lower_rad + kAtStop_rad &&
                                     q < model.joints[axis].upper_rad - kAtStop_rad));
  }
  return is_free;
}

std::vector<AxisSamples> SamplesByAxis(const MachineModel& model,
                                       const std::vector<NamedEncoders>& encoders, AxisLog* log) {
  std::vector<AxisSamples> samples(log->axes);
  for (const auto& [channel, recording] : encoders) {
    for (std::size_t i = 0; i < recording.axes.size(); ++i) {
      const EncoderAxis& named = recording.axes[i];
      const int axis = AxisNamed(model, named.name);
      if (axis < 0) continue;
      AxisSamples own = SamplesOf(recording, i);
      log->measured.push_back(
          {.channel = fmt::format("{}/{}{}", channel, named.name, named.linear ? "_mps" : "_radps"),
           .axis = static_cast<std::size_t>(axis),
           .t_ns = own.t_ns,
           .at_step = {},
           .rate_radps = own.rate_radps,
           .is_free = BetweenStops(model, axis, own.position_rad)});
      samples[axis] = std::move(own);
    }
  }
  return samples;
}

void SetTimes(const TableRecording& commands, AxisLog* log) {
  TimeNs first_ns = std::numeric_limits<TimeNs>::max(), last_ns = 0;
  for (const MeasuredRate& measured : log->measured) {
    if (measured.t_ns.empty()) continue;
    first_ns = std::min(first_ns, measured.t_ns.front());
    last_ns = std::max(last_ns, measured.t_ns.back());
  }
  if (commands.t_ns.empty() || first_ns > last_ns || commands.t_ns.front() >= last_ns) {
    throw InputError(fmt::format(
        "commands and encoders have no time in common: {} commands from {:.3f} s, encoders from "
        "{:.3f} s to {:.3f} s; need clocks that count from the same event (`time` of the import)",
        commands.t_ns.size(), commands.t_ns.empty() ? 0.0 : ToSeconds(commands.t_ns.front()),
        first_ns > last_ns ? 0.0 : ToSeconds(first_ns), ToSeconds(last_ns)));
  }
  log->start_ns = std::min(first_ns, commands.t_ns.front());
  if (ToSeconds(last_ns - log->start_ns) > kLongest_s) {
    throw InputError(fmt::format(
        "commands and encoders reach from {:.0f} s to {:.0f} s, over more than a day; need clocks "
        "that count from the same event (`time` of the import)",
        ToSeconds(log->start_ns), ToSeconds(last_ns)));
  }
  log->steps =
      static_cast<std::size_t>(std::ceil(ToSeconds(last_ns - log->start_ns) / log->step_s)) + 1;
  for (MeasuredRate& measured : log->measured) {
    for (const TimeNs t_ns : measured.t_ns) {
      measured.at_step.push_back(ToSeconds(t_ns - log->start_ns) / log->step_s);
    }
  }
}

/// Adds a command that holds between two times to the mean levers of the steps.
void Hold(double lever, double from_step, double to_step, std::size_t axis, AxisLog* log) {
  to_step = std::min(to_step, static_cast<double>(log->steps));
  for (double at = std::max(0.0, from_step); at < to_step;) {
    const double end = std::min(std::floor(at) + 1, to_step);
    log->lever[static_cast<std::size_t>(at) * log->axes + axis] += lever * (end - at);
    at = end;
  }
}

void SetLevers(const MachineModel& model, const TableRecording& commands, AxisLog* log) {
  log->lever.assign(log->steps * log->axes, 0.0);
  std::vector<std::string> names;
  for (const Lever& lever : model.levers) names.push_back(lever.name);
  bool any = false;
  for (std::size_t c = 0; c < commands.columns.size(); ++c) {
    const int lever = model.LeverIndex(commands.columns[c]);
    if (lever < 0) continue;
    any = true;
    const std::size_t axis = AxisOf(model, model.levers[lever]);
    const auto at_step = [&](std::size_t row) {
      return row < commands.t_ns.size()
                 ? ToSeconds(commands.t_ns[row] - log->start_ns) / log->step_s
                 : static_cast<double>(log->steps);
    };
    for (std::size_t row = 0; row < commands.rows.size(); ++row) {
      const double position = std::clamp(commands.rows[row][c], -1.0, 1.0);
      Hold(position, at_step(row), at_step(row + 1), axis, log);
    }
  }
  if (!any) {
    throw InputError(
        fmt::format("no lever channel: the commands have the columns {}; need one of {}",
                    fmt::join(commands.columns, ", "), fmt::join(names, ", ")));
  }
}

/// Sets `is_free` for samples at an end stop at the start of a motion away from it. The lever must
/// drive away from the stop. No recent lever may have driven into it.
void FreeDepartures(const MachineModel& model, const std::vector<AxisSamples>& samples,
                    AxisLog* log) {
  for (MeasuredRate& measured : log->measured) {
    if (measured.axis >= model.joints.size()) continue;
    const Joint& joint = model.joints[measured.axis];
    const std::vector<double>& position_rad = samples[measured.axis].position_rad;
    // From another encoder of the same axis.
    if (position_rad.size() != measured.is_free.size()) continue;
    double up_s = -INFINITY, down_s = -INFINITY;  // times of the last push in each direction
    std::size_t step = 0;
    for (std::size_t i = 0; i < measured.is_free.size(); ++i) {
      for (; step < log->steps && static_cast<double>(step) <= measured.at_step[i]; ++step) {
        const double lever = log->levers_at(step)[measured.axis];
        if (lever > kPush) up_s = static_cast<double>(step) * log->step_s;
        if (lever < -kPush) down_s = static_cast<double>(step) * log->step_s;
      }
      if (measured.is_free[i]) continue;
      const double now_s = measured.at_step[i] * log->step_s;
      const bool is_low = position_rad[i] - joint.lower_rad < joint.upper_rad - position_rad[i];
      const double away_s = is_low ? up_s : down_s, into_s = is_low ? down_s : up_s;
      measured.is_free[i] = now_s - away_s <= 2 * log->step_s && now_s - into_s > kLongestPush_s;
    }
  }
}

void SetMeasured(const AxisSamples& samples, std::size_t axis, AxisLog* log) {
  for (std::size_t k = 0; k < log->steps; ++k) {
    const TimeNs t_ns = log->start_ns + FromSeconds(static_cast<double>(k) * log->step_s);
    const BetweenSamples at(samples.t_ns, t_ns);
    AxisMotion& motion = log->motion[k * log->axes + axis];
    motion.position_rad = at.Of(samples.position_rad);
    motion.rate_radps = at.Of(samples.rate_radps);
  }
}

void SetMotion(const MachineModel& model, const std::vector<AxisSamples>& samples, AxisLog* log) {
  log->motion.resize(log->steps * log->axes);
  for (std::size_t axis = 0; axis < log->axes; ++axis) {
    if (!samples[axis].t_ns.empty()) {
      SetMeasured(samples[axis], axis, log);
    } else if (axis < model.joints.size()) {
      for (std::size_t k = 0; k < log->steps; ++k) {
        log->motion[k * log->axes + axis].position_rad = model.joints[axis].initial_rad;
      }
    }
  }
}

struct Weights {
  std::vector<double> load_nm, inertia_kgm2;
};

Weights WeightsAt(const MachineModel& model, const AxisLog& log, std::size_t step) {
  std::vector<double> q_rad(model.joints.size());
  for (std::size_t j = 0; j < q_rad.size(); ++j) q_rad[j] = log.motions_at(step)[j].position_rad;
  return {GravityLoads_nm(model, Pose::Identity(), q_rad), JointInertias_kgm2(model, q_rad)};
}

void SetWeights(const MachineModel& model, AxisLog* log) {
  log->inertia_kgm2.assign(log->steps * log->axes, 0.0);
  const auto stride =
      static_cast<std::size_t>(std::max(1.0, std::round(kLoadPeriod_s / log->step_s)));
  Weights from = WeightsAt(model, *log, 0);
  for (std::size_t first = 0; first < log->steps; first += stride) {
    const std::size_t last = std::min(first + stride, log->steps - 1);
    const Weights to = WeightsAt(model, *log, last);
    for (std::size_t k = first; k < std::min(first + stride, log->steps); ++k) {
      const double s = last > first ? static_cast<double>(k - first) / (last - first) : 0.0;
      for (std::size_t j = 0; j < model.joints.size(); ++j) {
        log->motion[k * log->axes + j].load_nm = std::lerp(from.load_nm[j], to.load_nm[j], s);
        log->inertia_kgm2[k * log->axes + j] =
            std::lerp(from.inertia_kgm2[j], to.inertia_kgm2[j], s);
      }
    }
    from = to;
  }
}

[[noreturn]] void ThrowNoAxis(const MachineModel& model,
                              const std::vector<NamedEncoders>& encoders) {
  std::vector<std::string> recorded, known;
  for (const NamedEncoders& named : encoders) {
    for (const EncoderAxis& axis : named.recording.axes) recorded.push_back(axis.name);
  }
  for (const Joint& joint : model.joints) known.push_back(joint.name);
  for (const RunningGear& gear : model.ground_tools.gears) known.push_back(gear.name);
  throw InputError(
      fmt::format("encoders measure no joint or gear of the machine, but {}; need one of {}",
                  recorded.empty() ? "nothing" : fmt::format("{}", fmt::join(recorded, ", ")),
                  fmt::join(known, ", ")));
}

}  // namespace

AxisSamples SamplesOf(const EncoderRecording& recording, std::size_t axis) {
  AxisSamples samples;
  for (const EncoderSample& sample : recording.samples) {
    samples.t_ns.push_back(sample.t_ns);
    samples.position_rad.push_back(sample.q_rad[axis]);
    samples.rate_radps.push_back(sample.qd_radps[axis]);
  }
  return samples;
}

std::optional<AxisSamples> SamplesOf(const std::string& axis,
                                     const std::vector<NamedEncoders>& encoders) {
  for (const auto& [channel, recording] : encoders) {
    for (std::size_t i = 0; i < recording.axes.size(); ++i) {
      if (recording.axes[i].name == axis && !recording.samples.empty()) {
        return SamplesOf(recording, i);
      }
    }
  }
  return std::nullopt;
}

BetweenSamples::BetweenSamples(const std::vector<TimeNs>& t_ns, TimeNs at_ns) {
  TERA_CHECK(!t_ns.empty(), at_ns);
  const auto next = std::lower_bound(t_ns.begin(), t_ns.end(), at_ns);
  if (next == t_ns.begin()) return;
  a = static_cast<std::size_t>(next - t_ns.begin()) - 1;
  b = next == t_ns.end() ? a : a + 1;
  if (b > a) s = static_cast<double>(at_ns - t_ns[a]) / static_cast<double>(t_ns[b] - t_ns[a]);
}

double BetweenSamples::Of(const std::vector<double>& values) const {
  return std::lerp(values[a], values[b], s);
}

std::size_t AxisOf(const MachineModel& model, const Lever& lever) {
  return lever.joint >= 0 ? static_cast<std::size_t>(lever.joint)
                          : model.joints.size() + static_cast<std::size_t>(lever.gear);
}

AxisLog MakeAxisLog(const MachineModel& model, const TableRecording& commands,
                    const std::vector<NamedEncoders>& encoders, double step_s) {
  AxisLog log;
  log.step_s = step_s;
  log.axes = model.joints.size() + model.gear_drives.size();
  const std::vector<AxisSamples> samples = SamplesByAxis(model, encoders, &log);
  if (log.measured.empty()) {
    ThrowNoAxis(model, encoders);
  }
  SetTimes(commands, &log);
  SetLevers(model, commands, &log);
  FreeDepartures(model, samples, &log);
  SetMotion(model, samples, &log);
  SetWeights(model, &log);
  return log;
}

}  // namespace tera
