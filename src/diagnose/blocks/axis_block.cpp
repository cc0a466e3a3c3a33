#include "diagnose/blocks/axis_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnose/blocks/actuation_candidates.h"
#include "diagnose/blocks/axis_readings.h"
#include "diagnose/blocks/candidate_list.h"
#include "diagnose/blocks/sample_grid.h"
#include "diagnose/replay/axis_replay.h"
#include "diagnose/statistics/series/robust.h"
#include "physics/actuation/actuation.h"
#include "physics/actuation/axes.h"

namespace tera {
namespace {

constexpr std::ptrdiff_t kFewestSamples = 200;
/// A rate that repeats longer than this without a lever counts as missing.
constexpr double kLongestRepeat_s = 1;
constexpr int kLeverLags = 12;  ///< number of lags of the lever in the flexible regressor
constexpr double kLongestLeverLag_s = 0.8;
/// The drive surely has this share of the model's effort. Samples that need more are excluded.
constexpr double kSureEffortShare = 0.5;
/// If a larger share of the moving samples would be excluded, none is excluded.
constexpr double kMostExcludedShare = 0.4;
/// Least share of the lever's active time in which it returns to neutral. Below it, the direction
/// of lever motion is no variable.
constexpr double kLeastReturnShare = 0.1;
constexpr std::size_t kOtherLevers =
    4;  ///< index of the first variable that is the lever of another axis
constexpr double kMovedLever = 0.05;  ///< another lever counts as moved above this value
/// Standard deviations of nominal numbers. A nuisance may deviate by two standard deviations
/// (likelihood.h). Rates: data sheets are right within 3 %. Full effort over inertia: effort,
/// masses and their positions have errors of about 3 % each, and inertia is quadratic in position.
constexpr double kNominalRate = 0.015, kNominalEffort = 0.07;

/// True if most samples of the moving axis repeat the previous one exactly. The measurement is then
/// slower than the samples.
bool IsHeld(const std::vector<double>& rate_radps) {
  std::size_t moving = 0, repeated = 0;
  for (std::size_t i = 1; i < rate_radps.size(); ++i) {
    if (rate_radps[i] == 0) continue;
    ++moving;
    repeated += rate_radps[i] == rate_radps[i - 1] ? 1 : 0;
  }
  return 2 * repeated > moving;
}

/// Samples that are new measurements. If the rate is held between measurements, only samples that
/// differ from the previous one are kept. Rates that repeat for long without a lever are excluded
/// in any case.
MeasuredRate Fresh(const MeasuredRate& measured, const AxisLog& log) {
  const bool held = IsHeld(measured.rate_radps);
  MeasuredRate fresh = measured;
  fresh.t_ns.clear();
  fresh.at_step.clear();
  fresh.rate_radps.clear();
  fresh.is_free.clear();
  std::size_t first = 0;
  for (std::size_t i = 0; i < measured.t_ns.size(); ++i) {
    const bool repeats = i > 0 && measured.rate_radps[i] == measured.rate_radps[i - 1];
    if (!repeats) first = i;
    const double stood_s = ToSeconds(measured.t_ns[i] - measured.t_ns[first]);
    const auto step = static_cast<std::size_t>(std::max(0.0, measured.at_step[i]));
    const bool pushed = log.levers_at(std::min(step, log.steps - 1))[measured.axis] != 0;
    if ((held && repeats) || (stood_s > kLongestRepeat_s && !pushed)) continue;
    fresh.t_ns.push_back(measured.t_ns[i]);
    fresh.at_step.push_back(measured.at_step[i]);
    fresh.rate_radps.push_back(measured.rate_radps[i]);
    fresh.is_free.push_back(measured.is_free[i]);
  }
  return fresh;
}

/// Excludes samples at which the drive's effort is exhausted. The rate then depends on other
/// joints, which yield, and on the cylinder's position, both unknown to the replay of one axis.
/// Keeps all samples if the effort is exhausted most of the time.
MeasuredRate WithinItsEffort(const AxisReplay& replay, MeasuredRate measured) {
  const std::vector<bool> falls_short =
      replay.FallsShort(replay.effects(), {.effort = kSureEffortShare});
  double moves = 0, lost = 0;
  for (std::size_t i = 0; i < falls_short.size(); ++i) {
    if (!measured.is_free[i] || measured.rate_radps[i] == 0) continue;
    ++moves;
    lost += falls_short[i] ? 1 : 0;
  }
  if (lost > kMostExcludedShare * moves) return measured;
  for (std::size_t i = 0; i < falls_short.size(); ++i) {
    if (falls_short[i]) measured.is_free[i] = false;
  }
  return measured;
}

/// A quantity of the log's steps on the grid: the value of the last step at or before each grid
/// point.
template <typename Value>
Series Sampled(const SampleGrid& grid, const AxisLog& log, const MeasuredRate& measured,
               const Value& value_at_step) {
  Series series{grid.period_s, std::vector<double>(grid.size), Mask(grid.size, 1)};
  const double first = measured.at_step.front();
  for (std::size_t k = 0; k < grid.size; ++k) {
    const double at = first + static_cast<double>(k) * grid.period_s / log.step_s;
    series.value[k] = value_at_step(std::min(static_cast<std::size_t>(at), log.steps - 1));
  }
  return series;
}

/// Functions of a lever that span valve responses.
std::array<double, 5> ShapesOf(double u) {
  const auto beyond = [&](double dead) {
    return std::copysign(std::max(0.0, std::abs(u) - dead), u);
  };
  return {u, u * std::abs(u), beyond(0.1), beyond(0.25), u > 0 ? 1.0 : (u < 0 ? -1.0 : 0.0)};
}

/// Columns: the lever times time, and the lever times the magnitude of each other lever.
Eigen::MatrixXd ByTimeAndOthers(const Series& lever, const std::vector<Series>& others) {
  const auto rows = static_cast<Eigen::Index>(lever.size());
  Eigen::MatrixXd columns(rows, static_cast<Eigen::Index>(2 + 2 * others.size()));
  for (Eigen::Index k = 0; k < rows; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double u = lever.value[at], t = static_cast<double>(k) / static_cast<double>(rows);
    Eigen::Index c = 0;
    for (const double x : {u * t, u * t * t}) columns(k, c++) = x;
    for (const Series& other : others) {
      const double v = std::abs(other.value[at]);
      for (const double x : {u * v, v > kMovedLever ? u : 0.0}) columns(k, c++) = x;
    }
  }
  return columns;
}

/// Columns: ShapesOf the lever at several lags, and products of the lever with position and load.
Eigen::MatrixXd ByLagAndPlace(const Series& lever, const Series& position, const Series& load) {
  const auto rows = static_cast<Eigen::Index>(lever.size());
  const double spread = std::max(RobustScale(position.value), 1e-9);
  const double middle = Median(position.value);
  double heaviest = 1e-9;
  for (const double nm : load.value) heaviest = std::max(heaviest, std::abs(nm));
  std::vector<std::size_t> lags;
  for (int i = 0; i < kLeverLags; ++i) {
    const double lag_s = kLongestLeverLag_s * std::pow(i / (kLeverLags - 1.0), 1.5);
    const auto lag = static_cast<std::size_t>(std::llround(lag_s / lever.period_s));
    if (lags.empty() || lag > lags.back()) lags.push_back(lag);
  }
  Eigen::MatrixXd columns(rows, static_cast<Eigen::Index>(5 * lags.size() + 8));
  for (Eigen::Index k = 0; k < rows; ++k) {
    Eigen::Index c = 0;
    for (const std::size_t lag : lags) {
      const auto past = k - static_cast<Eigen::Index>(lag);
      const double u = past < 0 ? 0 : lever.value[static_cast<std::size_t>(past)];
      for (const double shape : ShapesOf(u)) columns(k, c++) = shape;
    }
    const auto at = static_cast<std::size_t>(k);
    const double u = lever.value[at], l = load.value[at] / heaviest;
    const double q = std::clamp((position.value[at] - middle) / (3 * spread), -1.0, 1.0);
    for (const double x :
         {q, u * q, u * q * q, u * q * q * q, l, u * l, std::abs(u) * l, u * l * l}) {
      columns(k, c++) = x;
    }
  }
  return columns;
}

/// Changes of the prediction without candidates by the rate at full lever and by effort over
/// inertia, to second order. Where effort limits the rate, a larger rate is reached later.
Eigen::MatrixXd NominalColumns(const AxisReplay& replay, const SampleGrid& grid) {
  const auto predict = [&](double rate, double effort) -> Eigen::VectorXd {
    const std::vector<double> y =
        grid.Spread(replay.Predict(replay.effects(), {.rate = 1 + rate * kNominalRate,
                                                      .effort = 1 + effort * kNominalEffort}));
    return Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
  };
  const Eigen::VectorXd nominal = predict(0, 0);
  const Eigen::VectorXd faster = predict(1, 0) - nominal, slower = predict(-1, 0) - nominal;
  const Eigen::VectorXd stronger = predict(0, 1) - nominal, weaker = predict(0, -1) - nominal;
  Eigen::MatrixXd columns(nominal.size(), 5);
  // The second-order columns represent two standard deviations at a coefficient of two.
  columns << (faster - slower) / 2, faster + slower, (stronger - weaker) / 2, stronger + weaker,
      2 * (predict(1, 1) - nominal - faster - stronger);
  return columns;
}

Eigen::MatrixXd FlexibleRegressor(const std::vector<RegimeVariable>& variables) {
  const Series& lever = variables[0].series;
  std::vector<Series> others;
  for (std::size_t v = kOtherLevers; v < variables.size(); ++v)
    others.push_back(variables[v].series);
  const Eigen::MatrixXd place = ByLagAndPlace(lever, variables[1].series, variables[2].series);
  const Eigen::MatrixXd rest = ByTimeAndOthers(lever, others);
  Eigen::MatrixXd columns(place.rows(), place.cols() + rest.cols());
  columns << place, rest;
  return columns;
}

/// Effects with a structure's terms. Terms in the slot `flow` act on the pump, the others on the
/// axis.
AxisEffects WithTerms(const AxisEffects& present, const Structure& terms) {
  Structure of_axis, of_pump;
  for (const Term& term : terms) {
    (term.candidate->mechanism->slot == Slot::kFlow ? of_pump : of_axis).push_back(term);
  }
  return {WithTerms(present.axis, of_axis), WithTerms(present.pump, of_pump)};
}

/// Direction of motion of an axis's lever at each step.
std::vector<double> DirectionsOf(const AxisLog& log, std::size_t axis) {
  std::vector<double> ways;
  LeverWay way;
  for (std::size_t k = 0; k < log.steps; ++k) ways.push_back(way.Step(log.levers_at(k)[axis]));
  return ways;
}

/// True if the lever returns to neutral often enough to separate its direction of motion from its
/// sign. Steps to full lever and back are not enough.
bool ReturnsOften(const AxisLog& log, std::size_t axis, const std::vector<double>& ways) {
  std::size_t out = 0, back = 0;
  for (std::size_t k = 0; k < log.steps; ++k) {
    if (ways[k] == 0) continue;
    ++out;
    back += ways[k] * log.levers_at(k)[axis] < 0 ? 1 : 0;
  }
  return static_cast<double>(back) > kLeastReturnShare * static_cast<double>(out);
}

/// Variables of an axis: lever, position, load and time. The levers of the other axes follow from
/// index kOtherLevers on.
std::vector<RegimeVariable> VariablesOf(const MachineModel& model, const AxisLog& log,
                                        const MeasuredRate& measured, const SampleGrid& grid) {
  const std::size_t own = measured.axis;
  const auto lever_of = [&](std::size_t axis) {
    return Sampled(grid, log, measured, [&](std::size_t k) { return log.levers_at(k)[axis]; });
  };
  const auto motion_of = [&](double AxisMotion::*part) {
    return Sampled(grid, log, measured,
                   [&](std::size_t k) { return log.motions_at(k)[own].*part; });
  };
  const std::string name = NameOfAxis(model, own);
  std::vector<RegimeVariable> variables = {
      {"lever/" + name, lever_of(own)},
      {"position/" + name, motion_of(&AxisMotion::position_rad)},
      {"load/" + name, motion_of(&AxisMotion::load_nm)},
      {"time", Sampled(grid, log, measured,
                       [&](std::size_t k) { return static_cast<double>(k) * log.step_s; })}};
  for (std::size_t axis = 0; axis < log.axes; ++axis) {
    if (axis != own && HasLever(model, axis)) {
      variables.push_back({"lever/" + NameOfAxis(model, axis), lever_of(axis)});
    }
  }
  return variables;
}

/// Nominal numbers of an axis. Only candidates of the list give it a pump or a cylinder.
AxisChain ChainOf(const MachineModel& model, std::size_t axis,
                  const std::vector<Candidate>& candidates) {
  AxisChain chain{.axis = NameOfAxis(model, axis)};
  if (axis < model.joints.size()) {
    chain.full_positive_radps = model.joints[axis].max_rate_positive_radps;
    chain.full_negative_radps = model.joints[axis].max_rate_negative_radps;
  } else {
    chain.full_positive_radps = chain.full_negative_radps =
        model.gear_drives[axis - model.joints.size()].max_rate_radps;
  }
  for (const Candidate& candidate : candidates) {
    const std::string_view id = candidate.mechanism->id;
    if (id == "flow_sharing") chain.pump = candidate.target;
    if (id != "cylinder_lever") continue;
    MachineModel geared = model;
    geared.effects.joints.resize(model.joints.size());
    const std::vector<double>& start =
        candidate.present.empty() ? candidate.starts.front() : candidate.starts.back();
    geared.effects.joints[axis] = {{candidate.mechanism, start}};
    chain.cylinder_gain = [gain = KinematicGain(GainOf(geared, axis))](double position_rad) {
      return gain.Gain(position_rad);
    };
    chain.cylinder_reference_rad = start[3];
  }
  return chain;
}

}  // namespace

std::optional<ReplayBlock> MakeAxisBlock(const MachineModel& model, const AxisLog& log,
                                         std::size_t measured_index) {
  const MeasuredRate fresh = Fresh(log.measured[measured_index], log);
  const std::size_t axis = fresh.axis;
  if (!HasLever(model, axis) || fresh.t_ns.empty()) return std::nullopt;
  const AxisReplay replay(model, log, fresh);
  const MeasuredRate measured = WithinItsEffort(replay, fresh);
  if (std::count(measured.is_free.begin(), measured.is_free.end(), true) < kFewestSamples) {
    return std::nullopt;
  }
  const SampleGrid grid = SampleGrid::Under(measured.t_ns);
  Channel channel;
  channel.name = measured.channel;
  channel.unit = measured.channel.ends_with("_mps") ? "m/s" : "rad/s";
  channel.measured = grid.SpreadSeries(measured.rate_radps, measured.is_free);
  channel.nuisances = {.offset = 1e-3, .gain = 0.005, .delay_s = 0.5 * grid.period_s};
  channel.variables = VariablesOf(model, log, measured, grid);
  channel.flexible_regressor = FlexibleRegressor(channel.variables);
  const std::vector<double> ways = DirectionsOf(log, axis);
  if (ReturnsOften(log, axis, ways)) {
    channel.variables.push_back(
        {"lever_way/" + NameOfAxis(model, axis),
         Sampled(grid, log, measured, [&](std::size_t k) { return ways[k]; })});
  }
  ReplayBlock block;
  channel.nominal = NominalColumns(replay, grid);
  block.name = NameOfAxis(model, axis);
  block.slides = channel.unit == "m/s";
  block.first_ns = measured.t_ns.front();
  // Other levers act on the axis only through its position and load, and these are measured.
  block.commands = {channel.variables[0].series};
  block.channels.push_back(std::move(channel));
  block.candidates = CandidatesOfAxis(model, log, fresh, replay.pump());
  block.of_chance = LossOfAxis(model, axis);
  block.read_whole = [chain = ChainOf(model, axis, block.candidates)](const Channel& measured,
                                                                      const Mask& seen) {
    return ReadAxisChain(chain, measured, seen);
  };
  block.replay = [replay, grid](const Structure& terms, std::size_t samples) {
    const AxisEffects effects = WithTerms(replay.effects(), terms);
    const SampleGrid prefix = grid.First(samples);
    return std::vector<std::vector<double>>{
        prefix.Spread(replay.Predict(effects, {}, prefix.place.size()))};
  };
  if (LearnedAt(model.effects, axis) != nullptr) return block;
  block.learnable = LearnedVariablesOf(model, axis);
  block.change_by_learned = [replay, grid](const Structure& terms, const LearnedEffect& learned) {
    const AxisEffects effects = WithTerms(replay.effects(), terms);
    std::vector<double> change = replay.With(learned).Predict(effects);
    const std::vector<double> without = replay.Predict(effects);
    for (std::size_t k = 0; k < change.size(); ++k) change[k] -= without[k];
    return std::vector<std::vector<double>>{grid.Spread(change)};
  };
  return block;
}

std::vector<double> RateDiscrepancy(const MachineModel& model, const AxisLog& log,
                                    const AxisLog& simulated, std::size_t measured_index) {
  const MeasuredRate fresh = Fresh(log.measured[measured_index], log);
  if (!HasLever(model, fresh.axis) || fresh.t_ns.size() < 2) return {};
  const MeasuredRate& rates = simulated.measured[measured_index];
  MeasuredRate same{.channel = fresh.channel, .axis = fresh.axis};
  for (std::size_t i = 0, s = 0; i < fresh.t_ns.size(); ++i) {
    while (s < rates.t_ns.size() && rates.t_ns[s] < fresh.t_ns[i]) ++s;
    if (s == rates.t_ns.size()) break;
    same.t_ns.push_back(rates.t_ns[s]);
    same.at_step.push_back(rates.at_step[s]);
    same.rate_radps.push_back(rates.rate_radps[s]);
    same.is_free.push_back(rates.is_free[s]);
  }
  const AxisReplay replay(model, simulated, same);
  const std::vector<double> replayed = replay.Predict(replay.effects());
  std::vector<double> left(fresh.t_ns.size(), 0.0);
  for (std::size_t i = 0; i < replayed.size(); ++i) left[i] = same.rate_radps[i] - replayed[i];
  return SampleGrid::Under(fresh.t_ns).Spread(left);
}

}  // namespace tera
