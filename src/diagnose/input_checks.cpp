#include "diagnose/input_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>

#include "core/error.h"
#include "core/units.h"
#include "diagnose/statistics/series/robust.h"
#include "physics/actuation/axes.h"

namespace tera {
namespace {

constexpr double kDegrees = 1 / kDeg;
constexpr double kMostUnitRatio = 1.3;     ///< a factor matches a unit factor up to this ratio
constexpr double kLeastCorrelation = 0.7;  ///< least correlation of proportional columns
constexpr double kLeastLeverRange = 0.2;
constexpr double kLeastRange_rad = 0.05;  ///< least range of a position that moves
constexpr double kLeastWay_m = 2;  ///< least distance between start and end of a base that drives
constexpr double kBeyondLimit_rad = 0.2;  ///< tolerated excess of a position over a joint's limits
/// Distance in time of the two positions that are compared with a rate.
constexpr double kPair_s = 0.1;
constexpr double kLongestDelay_s = 0.9;  ///< longest delay of a rate behind its lever
/// Commands may end earlier than other channels by this time. If they end even earlier, they belong
/// to another time.
constexpr double kMostEarlyEnd_s = 10;
constexpr const char* kNotConverted = "nothing is converted: give its unit in the import";

struct Ends {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void Add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  double Span() const { return high < low ? 0 : high - low; }
};

bool IsNear(double found, double factor) {
  return found > 0 && std::abs(std::log(found / factor)) < std::log(kMostUnitRatio);
}

/// Probable unit of numbers that are `factor` times their value in `si_unit`. Empty if no unit
/// fits.
std::string UnitBehind(double factor, const std::string& si_unit) {
  const bool is_angle = si_unit.starts_with("rad");
  const std::string rest = si_unit.substr(is_angle ? 3 : std::min<std::size_t>(1, si_unit.size()));
  if (is_angle && IsNear(factor, kDegrees)) return "deg" + rest;
  if (IsNear(factor, 1000)) return "m" + si_unit;
  if (is_angle && IsNear(factor, 1 / kDegrees)) return si_unit + ", taken for deg" + rest;
  if (IsNear(factor, 0.001)) return si_unit + ", taken for m" + si_unit;
  return "";
}

std::string FileOf(const RecordedPlace& place, const std::string& channel) {
  return fmt::format("{}/{}/data.csv", place.directory, channel);
}

/// Slope of y over x about their means, and correlation.
struct Proportion {
  double factor = 0, correlation = 0;
};

Proportion ProportionOf(const std::vector<double>& y, const std::vector<double>& x) {
  const auto count = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    mean_x += x[k] / count;
    mean_y += y[k] / count;
  }
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
    yy += (y[k] - mean_y) * (y[k] - mean_y);
  }
  if (xx <= 0 || yy <= 0) return {};
  return {xy / xx, xy / std::sqrt(xx * yy)};
}

/// True if the lever of the joint or running gear `axis` moves.
bool LeverMoves(const TableRecording& commands, const MachineModel& model,
                const std::string& axis) {
  for (std::size_t c = 0; c < commands.columns.size(); ++c) {
    const int index = model.LeverIndex(commands.columns[c]);
    if (index < 0) continue;
    const Lever& lever = model.levers[static_cast<std::size_t>(index)];
    if (NameOfAxis(model, AxisOf(model, lever)) != axis) continue;
    Ends ends;
    for (const auto& row : commands.rows) ends.Add(row[c]);
    return ends.Span() > kLeastLeverRange;
  }
  return false;
}

/// Position and rate columns of one joint or running gear.
struct AxisColumns {
  std::string file, position, rate, position_unit, rate_unit;
  std::vector<TimeNs> t_ns;
  std::vector<double> q, qd;
};

AxisColumns ColumnsOf(const RecordedPlace& place, const NamedEncoders& encoders, std::size_t axis) {
  const EncoderAxis& named = encoders.recording.axes[axis];
  AxisColumns columns;
  columns.file = FileOf(place, encoders.channel);
  columns.position_unit = named.linear ? "m" : "rad";
  columns.rate_unit = columns.position_unit + "/s";
  columns.position = named.name + (named.linear ? "_m" : "_rad");
  columns.rate = named.name + (named.linear ? "_mps" : "_radps");
  AxisSamples samples = SamplesOf(encoders.recording, axis);
  columns.t_ns = std::move(samples.t_ns);
  columns.q = std::move(samples.position_rad);
  columns.qd = std::move(samples.rate_radps);
  return columns;
}

Ends EndsOf(const std::vector<double>& values) {
  Ends ends;
  for (const double x : values) ends.Add(x);
  return ends;
}

void RequireMoving(const AxisColumns& axis, bool lever_moves) {
  const double q_span = EndsOf(axis.q).Span(), qd_span = EndsOf(axis.qd).Span();
  const bool moves = q_span > kLeastRange_rad || lever_moves;
  if (qd_span == 0 && moves) {
    throw InputError(
        axis.file, fmt::format("column '{}' is {} in all {} samples while {}; need the rate that "
                               "was measured, or a recording without this joint",
                               axis.rate, axis.qd.front(), axis.qd.size(),
                               q_span > kLeastRange_rad ? fmt::format("'{}' changes", axis.position)
                                                        : "its lever moves"));
  }
  if (q_span == 0 && qd_span > 0 && lever_moves) {
    throw InputError(axis.file,
                     fmt::format("column '{}' is {} in all {} samples while '{}' changes and its "
                                 "lever moves; need the position that was measured",
                                 axis.position, axis.q.front(), axis.q.size(), axis.rate));
  }
}

/// Throws if rates are a unit factor times the changes of positions, over steps of kPair_s.
void RequireRatesOfPositions(const AxisColumns& axis) {
  std::vector<double> change, rate;
  std::size_t from = 0;
  double sum = 0;
  for (std::size_t k = 1; k < axis.q.size(); ++k) {
    sum += axis.qd[k];
    const double span_s = ToSeconds(axis.t_ns[k] - axis.t_ns[from]);
    if (span_s < kPair_s) continue;
    change.push_back((axis.q[k] - axis.q[from]) / span_s);
    rate.push_back(sum / static_cast<double>(k - from));
    from = k;
    sum = 0;
  }
  if (change.size() < 20) return;
  const Proportion found = ProportionOf(rate, change);
  if (found.correlation < kLeastCorrelation) return;
  const std::string unit = UnitBehind(found.factor, axis.rate_unit);
  if (unit.empty()) return;
  throw InputError(axis.file,
                   fmt::format("column '{}' is {:.3g} times what '{}' changes by in a second; need "
                               "{} and {}. Is the rate in {}, or the position in another unit? {}",
                               axis.rate, found.factor, axis.position, axis.rate_unit,
                               axis.position_unit, unit, kNotConverted));
}

/// Throws if positions exceed the joint's limits but would be within them in another unit.
void RequireWithinLimits(const AxisColumns& axis, const Joint& joint) {
  if (joint.type == JointType::kContinuous || joint.lower_rad >= joint.upper_rad) return;
  const auto beyond = [&](double factor) {
    std::size_t count = 0;
    for (const double q : axis.q) {
      const double real = q / factor;
      count +=
          real < joint.lower_rad - kBeyondLimit_rad || real > joint.upper_rad + kBeyondLimit_rad
              ? 1
              : 0;
    }
    return static_cast<double>(count) / static_cast<double>(axis.q.size());
  };
  if (beyond(1) < 0.5) return;
  for (const double factor : {kDegrees, 1000.0}) {
    const std::string unit = UnitBehind(factor, axis.position_unit);
    if (unit.empty() || beyond(factor) > 0.01) continue;
    throw InputError(axis.file, fmt::format("column '{}' goes from {:.4g} to {:.4g}, and the joint "
                                            "from {:.4g} to {:.4g} {}. Is it in {}? {}",
                                            axis.position, EndsOf(axis.q).low, EndsOf(axis.q).high,
                                            joint.lower_rad, joint.upper_rad, axis.position_unit,
                                            unit, kNotConverted));
  }
}

struct TimeSpan {
  std::string what;
  TimeNs first_ns = 0, last_ns = 0;
};

template <typename Sample>
void AddSpan(const std::string& what, const std::vector<Sample>& samples,
             std::vector<TimeSpan>* spans) {
  if (!samples.empty()) spans->push_back({what, samples.front().t_ns, samples.back().t_ns});
}

/// East or north positions of a receiver and of the machine's poses, at the receiver's times.
struct Ways {
  std::vector<double> receiver_m, machine_m;
};

Ways WaysOf(const std::vector<GnssSample>& samples, const std::vector<TruthPose>& poses, int axis) {
  Ways ways;
  for (const GnssSample& sample : samples) {
    const auto at = std::lower_bound(poses.begin(), poses.end(), sample.t_ns,
                                     [](const TruthPose& p, TimeNs t) { return p.t_ns < t; });
    if (sample.fix == GnssFix::kNone || at == poses.end()) continue;
    ways.receiver_m.push_back(sample.enu_m[axis]);
    ways.machine_m.push_back(at->X_WB.translation()[axis]);
  }
  return ways;
}

/// True if a measured rate follows the expected one with a delay.
bool FollowsLate(const Series& measured, const std::vector<double>& expected) {
  const auto steps = static_cast<std::size_t>(kLongestDelay_s / measured.period_s);
  const std::size_t stride = std::max<std::size_t>(1, steps / 16);
  for (std::size_t lag = stride; lag <= steps; lag += stride) {
    std::vector<double> now, before;
    for (std::size_t k = lag; k < measured.size(); ++k) {
      if (!measured.valid[k]) continue;
      now.push_back(measured.value[k]);
      before.push_back(expected[k - lag]);
    }
    if (ProportionOf(now, before).correlation > kLeastCorrelation) return true;
  }
  return false;
}

}  // namespace

void CheckLevers(const RecordedPlace& place, const TableRecording& commands,
                 const MachineModel& model) {
  for (std::size_t c = 0; c < commands.columns.size(); ++c) {
    if (model.LeverIndex(commands.columns[c]) < 0) continue;
    double largest = 0;
    for (const auto& row : commands.rows) largest = std::max(largest, std::abs(row[c]));
    if (largest <= 1 + 1e-9) continue;
    const char* unit = largest <= 1.1                     ? ""
                       : largest > 10 && largest <= 105   ? " Is it in percent?"
                       : largest > 200 && largest <= 1050 ? " Is it in parts of a thousand?"
                                                          : "";
    throw InputError(fmt::format("{}/{}/commands.csv", place.directory, place.machine),
                     {FaultKind::kOutOfRange,
                      fmt::format("column '{}' reaches {:.4g}; need -1 to 1 of full lever.{} {}",
                                  commands.columns[c], largest, unit, kNotConverted)});
  }
}

void CheckClocks(const RecordedPlace& place, const TableRecording& commands,
                 const std::vector<NamedEncoders>& encoders,
                 const std::vector<std::vector<ImuSample>>& imus,
                 const std::vector<std::vector<GnssSample>>& gnss,
                 const std::vector<TruthPose>& poses) {
  std::vector<TimeSpan> spans;
  for (const NamedEncoders& named : encoders) {
    AddSpan(named.channel, named.recording.samples, &spans);
  }
  for (const auto& samples : imus) AddSpan("an inertial unit", samples, &spans);
  for (const auto& samples : gnss) AddSpan("a receiver", samples, &spans);
  AddSpan("poses", poses, &spans);
  if (!commands.t_ns.empty() && !spans.empty()) {
    // A command holds until the next one.
    const TimeNs last_ns = commands.t_ns.size() == 1
                               ? std::numeric_limits<TimeNs>::max()
                               : commands.t_ns.back() + FromSeconds(kMostEarlyEnd_s);
    spans.push_back({"commands", commands.t_ns.front(), last_ns});
  }
  for (std::size_t k = 1; k < spans.size(); ++k) {
    const TimeSpan &a = spans.front(), &b = spans[k];
    if (a.first_ns <= b.last_ns && b.first_ns <= a.last_ns) continue;
    throw InputError(
        place.directory,
        fmt::format("{} and {} have no time in common, {:.3f} s to {:.3f} s and {:.3f} s to {:.3f} "
                    "s; need clocks that count from the same event (`time` of the import)",
                    a.what, b.what, ToSeconds(a.first_ns), ToSeconds(a.last_ns),
                    ToSeconds(b.first_ns),
                    ToSeconds(b.what == "commands" ? commands.t_ns.back() : b.last_ns)));
  }
}

void CheckEncoders(const RecordedPlace& place, const TableRecording& commands,
                   const std::vector<NamedEncoders>& encoders, const MachineModel& model) {
  for (const NamedEncoders& named : encoders) {
    for (std::size_t i = 0; i < named.recording.axes.size(); ++i) {
      const AxisColumns axis = ColumnsOf(place, named, i);
      if (axis.q.empty()) continue;
      const std::string& name = named.recording.axes[i].name;
      RequireMoving(axis, LeverMoves(commands, model, name));
      if (const int joint = model.JointIndex(name); joint >= 0) {
        RequireWithinLimits(axis, model.joints[static_cast<std::size_t>(joint)]);
      }
      RequireRatesOfPositions(axis);
    }
  }
}

void CheckImu(const RecordedPlace& place, const std::string& channel,
              const std::vector<ImuSample>& samples) {
  if (samples.empty()) return;
  constexpr std::array<const char*, 6> kColumns = {"wx_radps", "wy_radps", "wz_radps",
                                                   "ax_mps2",  "ay_mps2",  "az_mps2"};
  std::array<Ends, 6> ends;
  std::vector<double> force_mps2;
  for (const ImuSample& sample : samples) {
    for (std::size_t i = 0; i < 3; ++i) {
      ends[i].Add(sample.w_WS_S_radps[static_cast<Eigen::Index>(i)]);
      ends[3 + i].Add(sample.f_S_mps2[static_cast<Eigen::Index>(i)]);
    }
    force_mps2.push_back(sample.f_S_mps2.norm());
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t first = i < 3 ? 0 : 3;
    const bool others_change =
        ends[first].Span() + ends[first + 1].Span() + ends[first + 2].Span() > 0;
    if (ends[i].Span() > 0 || !others_change) continue;
    throw InputError(FileOf(place, channel),
                     fmt::format("column '{}' is {} in all {} samples while others change; need "
                                 "what the unit measured, or a recording without it",
                                 kColumns[i], ends[i].low, samples.size()));
  }
  const double usual_mps2 = Median(force_mps2);
  const char* unit = IsNear(usual_mps2, 1)                              ? "g (9.80665 m/s²)"
                     : IsNear(usual_mps2, 1000)                         ? "thousandths of g"
                     : IsNear(usual_mps2, 1000 * kStandardGravity_mps2) ? "mm/s²"
                                                                        : nullptr;
  if (unit == nullptr) return;
  throw InputError(
      FileOf(place, channel),
      fmt::format(
          "the specific force is {:.4g} at the median, and gravity's {:.3f} m/s². Is it in {}? {}",
          usual_mps2, kStandardGravity_mps2, unit, kNotConverted));
}

void CheckGnss(const RecordedPlace& place, const std::string& channel,
               const std::vector<GnssSample>& samples, const std::vector<TruthPose>& poses) {
  constexpr std::array<const char*, 2> kColumns = {"east_m", "north_m"};
  for (int axis = 0; axis < 2; ++axis) {
    const Ways ways = WaysOf(samples, poses, axis);
    if (ways.receiver_m.empty() || EndsOf(ways.machine_m).Span() < kLeastWay_m) continue;
    const char* column = kColumns[static_cast<std::size_t>(axis)];
    if (EndsOf(ways.receiver_m).Span() == 0) {
      throw InputError(
          FileOf(place, channel),
          fmt::format("column '{}' is {} in all {} samples with a fix while the machine goes "
                      "{:.1f} m; need what the receiver measured, or a recording without it",
                      column, ways.receiver_m.front(), ways.receiver_m.size(),
                      EndsOf(ways.machine_m).Span()));
    }
    const Proportion found = ProportionOf(ways.receiver_m, ways.machine_m);
    const std::string unit = UnitBehind(found.factor, "m");
    if (found.correlation < kLeastCorrelation || unit.empty()) continue;
    throw InputError(FileOf(place, channel),
                     fmt::format("column '{}' changes by {:.3g} times what the machine's poses do; "
                                 "need m. Is it in {}? {}",
                                 column, found.factor, unit, kNotConverted));
  }
}

void CheckUnitsOf(const RecordedPlace& place, const std::vector<ReplayBlock>& blocks) {
  for (const ReplayBlock& block : blocks) {
    const auto predicted = block.predict({});
    for (std::size_t c = 0; c < block.channels.size(); ++c) {
      const Channel& channel = block.channels[c];
      std::vector<double> measured, expected;
      for (std::size_t k = 0; k < channel.measured.size(); ++k) {
        if (!channel.measured.valid[k]) continue;
        measured.push_back(channel.measured.value[k]);
        expected.push_back(predicted[c][k]);
      }
      if (measured.empty()) continue;
      const Proportion found = ProportionOf(measured, expected);
      const bool is_of_axis = block.channels.size() == 1 && channel.unit.ends_with("/s");
      if (is_of_axis && found.correlation < -kLeastCorrelation) {
        if (FollowsLate(channel.measured, predicted[c])) continue;
        throw InputError(place.directory,
                         fmt::format("{} goes against its lever (correlation {:.2f}); need the "
                                     "signs of the scenario's machine, in levers and encoders",
                                     channel.name, found.correlation));
      }
      if (found.correlation < kLeastCorrelation) continue;
      const std::string unit = UnitBehind(found.factor, channel.unit);
      if (unit.empty()) continue;
      throw InputError(place.directory,
                       fmt::format("{} is {:.3g} times what the scenario says of it (correlation "
                                   "{:.2f}); need {}. Is it in {}? {}",
                                   channel.name, found.factor, found.correlation, channel.unit,
                                   unit, kNotConverted));
    }
  }
}

}  // namespace tera
