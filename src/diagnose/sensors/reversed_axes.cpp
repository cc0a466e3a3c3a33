#include "diagnose/sensors/reversed_axes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnose/motion/starting_motion.h"
#include "diagnose/statistics/tests/opposition.h"
#include "sensors/encoder/encoder_errors.h"

namespace tera {
namespace {

constexpr double kOver_s = 0.2;  ///< span of a difference of positions
constexpr double kFurthest_s = 0.5, kReversedLag_s = 0.05;
constexpr double kLeastCorrelation = 0.7;
constexpr std::size_t kFewestRates = 50;

TimeSeries RatesOf(const EncoderRecording& recording, std::size_t axis) {
  TimeSeries rates;
  const auto& samples = recording.samples;
  for (std::size_t from = 0, to = 0; from < samples.size(); from = to) {
    while (to < samples.size() && samples[to].t_ns - samples[from].t_ns < FromSeconds(kOver_s))
      ++to;
    if (to == samples.size()) break;
    const double over_s = ToSeconds(samples[to].t_ns - samples[from].t_ns);
    if (over_s > 2 * kOver_s) continue;
    rates.t_s.push_back(ToSeconds(samples[from].t_ns) + over_s / 2);
    rates.value.push_back((samples[to].q_rad[axis] - samples[from].q_rad[axis]) / over_s);
  }
  return rates;
}

/// Turn rate of a unit about an axis of its link, averaged over spans of kOver_s.
TimeSeries TurnsAbout(const SensorDescription& unit, const std::vector<ImuSample>& samples,
                      const Vec3& axis_L) {
  const Vec3 axis_S = unit.X_BS.linear().transpose() * axis_L;
  TimeSeries turns;
  for (std::size_t from = 0; from < samples.size();) {
    double sum = 0, count = 0, at_s = 0;
    std::size_t k = from;
    for (; k < samples.size() && samples[k].t_ns - samples[from].t_ns < FromSeconds(kOver_s); ++k) {
      sum += samples[k].w_WS_S_radps.dot(axis_S), at_s += ToSeconds(samples[k].t_ns), ++count;
    }
    turns.t_s.push_back(at_s / count);
    turns.value.push_back(sum / count);
    from = k;
  }
  return turns;
}

/// Index of the first unit with samples on a link.
std::optional<std::size_t> UnitOf(const DiagnosisInput& input, const Measurements& measured,
                                  int link) {
  for (std::size_t s = 0; s < input.sensors.size(); ++s) {
    const bool is_there = input.model->LinkIndex(input.sensors[s].link) == link;
    if (is_there && !measured.imus[s].empty()) return s;
  }
  return std::nullopt;
}

/// Turn rate of a hinge, from the units behind and before it.
TimeSeries TurnsOfHinge(const DiagnosisInput& input, const Measurements& measured, int joint) {
  const Joint& hinge = input.model->joints[static_cast<std::size_t>(joint)];
  const auto behind = UnitOf(input, measured, hinge.child),
             before = UnitOf(input, measured, hinge.parent);
  if (!behind || !before) return {};
  TimeSeries turns = TurnsAbout(input.sensors[*behind], measured.imus[*behind], hinge.axis_J);
  const TimeSeries carried = TurnsAbout(input.sensors[*before], measured.imus[*before],
                                        hinge.X_PJ.linear() * hinge.axis_J);
  for (std::size_t k = 0; k < turns.t_s.size(); ++k) {
    turns.value[k] -= carried.At(turns.t_s[k]);
  }
  return turns;
}

TimeSeries LeverOf(const DiagnosisInput& input, int joint) {
  TimeSeries lever;
  for (const Lever& one : input.model->levers) {
    const auto& columns = input.commands.columns;
    const auto column = std::find(columns.begin(), columns.end(), one.name);
    if (one.joint != joint || column == columns.end()) continue;
    for (std::size_t k = 0; k < input.commands.rows.size(); ++k) {
      lever.t_s.push_back(ToSeconds(input.commands.t_ns[k]));
      lever.value.push_back(
          input.commands.rows[k][static_cast<std::size_t>(column - columns.begin())]);
    }
  }
  return lever;
}

/// Uncentred, so that samples at rest add nothing.
double CorrelationAt(const TimeSeries& rates, const TimeSeries& other, double late_s) {
  double both = 0, one = 0, two = 0;
  for (std::size_t k = 0; k < rates.t_s.size(); ++k) {
    const double a = rates.value[k], b = other.At(rates.t_s[k] - late_s);
    both += a * b, one += a * a, two += b * b;
  }
  return one > 0 && two > 0 ? both / std::sqrt(one * two) : 0;
}

struct Likeness {
  double correlation = 0;
  double p = 1;  ///< p-value of the opposition
};

/// The correlation of largest magnitude over delays. p is corrected for the number of delays.
Likeness MostAlike(const TimeSeries& rates, const TimeSeries& other) {
  Likeness most;
  if (other.empty()) return most;
  const int lags = static_cast<int>(std::lround(kFurthest_s / kReversedLag_s));
  double late_s = 0;
  for (int lag = -lags; lag <= lags; ++lag) {
    const double here = CorrelationAt(rates, other, lag * kReversedLag_s);
    if (std::abs(here) <= std::abs(most.correlation)) continue;
    most.correlation = here;
    late_s = lag * kReversedLag_s;
  }
  std::vector<double> beside;
  for (const double t_s : rates.t_s) beside.push_back(other.At(t_s - late_s));
  most.p = std::min(1.0, (2 * lags + 1) * OppositionP(rates.value, beside));
  return most;
}

double RmsApart(const TimeSeries& rates, const TimeSeries& other, double sign) {
  double square = 0;
  for (std::size_t k = 0; k < rates.t_s.size(); ++k) {
    square += std::pow(sign * rates.value[k] - other.At(rates.t_s[k]), 2);
  }
  return std::sqrt(square / static_cast<double>(rates.t_s.size()));
}

double PivotOf(const Joint& hinge, double first_rad) {
  const double middle_rad = (hinge.lower_rad + hinge.upper_rad) / 2;
  const double off_zero = std::abs(-first_rad - hinge.initial_rad),
               off_middle = std::abs(2 * middle_rad - first_rad - hinge.initial_rad);
  return off_middle < off_zero ? middle_rad : 0;
}

std::optional<ReversedAxis> Reversed(const DiagnosisInput& input, const Measurements& measured,
                                     const NamedEncoders& named, const SensorDescription& sensor,
                                     std::size_t axis) {
  const EncoderRecording& recording = named.recording;
  const int joint = input.model->JointIndex(recording.axes[axis].name);
  if (joint < 0) return std::nullopt;
  const Joint& hinge = input.model->joints[static_cast<std::size_t>(joint)];
  if (hinge.type != JointType::kRevolute) return std::nullopt;
  const TimeSeries rates = RatesOf(recording, axis), turns = TurnsOfHinge(input, measured, joint);
  if (rates.t_s.size() < kFewestRates || turns.empty()) return std::nullopt;
  ReversedAxis found{sensor.name + "/" + hinge.name, named.channel, hinge.name};
  const Likeness units = MostAlike(rates, turns), lever = MostAlike(rates, LeverOf(input, joint));
  found.with_units = units.correlation;
  found.with_lever = lever.correlation;
  found.p = std::max(units.p, lever.p);
  if (std::max(found.with_units, found.with_lever) > -kLeastCorrelation) return std::nullopt;
  const auto own = sensor.axis_effects.find(hinge.name);
  const Effects effects =
      EffectsOfAxis(sensor.effects, own == sensor.axis_effects.end() ? Effects{} : own->second);
  found.is_documented = FindEffect(effects, "axis_flip") != nullptr;
  found.pivot_rad =
      recording.samples.empty() ? 0 : PivotOf(hinge, recording.samples.front().q_rad[axis]);
  found.rms_before_radps = RmsApart(rates, turns, 1);
  found.rms_after_radps = RmsApart(rates, turns, -1);
  return found;
}

}  // namespace

std::vector<ReversedAxis> ReversedAxesOf(const DiagnosisInput& input,
                                         const Measurements& measured) {
  std::vector<ReversedAxis> reversed;
  for (const NamedEncoders& named : measured.encoders) {
    for (const SensorDescription& sensor : input.sensors) {
      if (named.channel != input.machine + "/" + sensor.name) continue;
      for (std::size_t axis = 0; axis < named.recording.axes.size(); ++axis) {
        if (auto one = Reversed(input, measured, named, sensor, axis)) reversed.push_back(*one);
      }
    }
  }
  return reversed;
}

void CountForwards(const std::vector<ReversedAxis>& reversed, Measurements* measured) {
  for (const ReversedAxis& one : reversed) {
    for (NamedEncoders& named : measured->encoders) {
      if (named.channel != one.channel) continue;
      const auto& axes = named.recording.axes;
      const auto found = std::find_if(
          axes.begin(), axes.end(), [&](const EncoderAxis& axis) { return axis.name == one.axis; });
      const auto axis = static_cast<std::size_t>(found - axes.begin());
      for (EncoderSample& sample : named.recording.samples) {
        sample.q_rad[axis] = 2 * one.pivot_rad - sample.q_rad[axis];
        sample.qd_radps[axis] = -sample.qd_radps[axis];
      }
    }
  }
}

}  // namespace tera
