#include "diagnose/blocks/imu_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "diagnose/blocks/candidate_list.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/blocks/sample_grid.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

constexpr std::ptrdiff_t kFewestImuIntervals = 100;
constexpr std::size_t kQuantities = 6;
/// Least correlation of successive intervals in a predicted quantity that shows motion.
constexpr double kLeastCorrelation = 0.3;
/// A link is at rest if it always turns more slowly than this.
constexpr double kLeastLinkTurning_radps = 0.02;
constexpr std::array<const char*, kQuantities> kColumns = {"wx_radps", "wy_radps", "wz_radps",
                                                           "ax_mps2",  "ay_mps2",  "az_mps2"};
/// Lags in the flexible regressor, in intervals.
constexpr std::array<std::size_t, 4> kImuLags = {0, 1, 2, 4};

using Quantities = std::array<std::vector<double>, kQuantities>;

/// One value for the three rates and another for the three forces.
std::vector<double> Triads(double gyro, double accel) {
  return {gyro, gyro, gyro, accel, accel, accel};
}

std::vector<FreeParameter> Axes(std::size_t first, double gyro_lower, double gyro_upper,
                                double accel_lower, double accel_upper) {
  std::vector<FreeParameter> free;
  for (std::size_t i = 0; i < 3; ++i) free.push_back({first + i, gyro_lower, gyro_upper});
  for (std::size_t i = 3; i < 6; ++i) free.push_back({first + i, accel_lower, accel_upper});
  return free;
}

/// True if a predicted quantity shows motion, which persists between intervals. Differentiated
/// encoder noise alternates in sign instead. A fit to such noise would prefer any scale factor
/// below 1.
bool IsExcited(const std::vector<double>& predicted) {
  double mean = 0, square = 0, next = 0;
  for (const double x : predicted) mean += x / static_cast<double>(predicted.size());
  for (std::size_t k = 0; k < predicted.size(); ++k) {
    square += std::pow(predicted[k] - mean, 2);
    if (k > 0) next += (predicted[k] - mean) * (predicted[k - 1] - mean);
  }
  return next > kLeastCorrelation * square;
}

bool IsAtRest(const Quantities& predicted) {
  return std::all_of(predicted.begin(), predicted.begin() + 3, [](const std::vector<double>& w) {
    return std::all_of(w.begin(), w.end(),
                       [](double one) { return std::abs(one) < kLeastLinkTurning_radps; });
  });
}

void AddScale(const Quantities& predicted, CandidateList* out) {
  std::vector<FreeParameter> free = Axes(0, 0.7, 1.4, 0.7, 1.4);
  std::vector<std::vector<double>> starts = {Triads(1.005, 1.005), Triads(1.02, 1.02),
                                             Triads(0.97, 0.97), Triads(1.1, 1.1)};
  std::erase_if(free, [&](const FreeParameter& one) { return !IsExcited(predicted[one.index]); });
  for (std::size_t i = 0; i < kQuantities; ++i) {
    if (IsExcited(predicted[i])) continue;
    for (auto& start : starts) start[i] = 1;
  }
  if (!free.empty()) out->Add("scale", std::move(free), std::move(starts));
}

void AddStatic(CandidateList* out) {
  out->Add("bias", Axes(0, -10, 10, -5, 5),
           {Triads(0.03, 0.02), Triads(0.1, 0.05), Triads(0.3, 0.2), Triads(1, 0.5)});
  auto drift = Axes(2, -0.1, 0.1, -0.02, 0.02);
  drift.push_back({1, 10, 5000, true});
  std::vector<std::vector<double>> starts;
  for (const double strength : {1.0, 4.0, 16.0}) {
    for (const double time_s : {60.0, 600.0}) {
      std::vector<double> start = {30, time_s};
      for (const double x : Triads(0.001 * strength, 0.0005 * strength)) start.push_back(x);
      starts.push_back(std::move(start));
    }
  }
  out->Add("temperature_drift", std::move(drift), std::move(starts));
}

void AddDirections(CandidateList* out) {
  out->Add("mount_rotation", {{0, -180, 180}, {1, -90, 90}, {2, -180, 180}},
           {{0.5, 0.5, 0.5},
            {2, 0, 0},
            {0, 2, 0},
            {0, 0, 2},
            {8, 0, 0},
            {0, 8, 0},
            {0, 0, 8},
            {0, 0, 90},
            {0, 0, -90},
            {0, 0, 180},
            {180, 0, 0}});
  std::vector<std::vector<double>> flips = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0},
                                            {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  for (auto& axes : flips) axes.resize(9);  // parameters 3 to 8: no flips in only one of the triads
  out->Add("axis_flip", {}, std::move(flips));
}

void AddPlace(CandidateList* out) {
  out->Add("imu_lever_arm", {{0, -4, 4}, {1, -4, 4}, {2, -4, 4}},
           {{0.05, 0.05, 0.05}, {0.3, 0, 0}, {0, 0.3, 0}, {0, 0, 0.3}, {1, 0, 0}, {-1, 0, 0}});
}

void AddTiming(CandidateList* out) {
  out->Add("clock_offset", {{0, -3, 3}}, {{0.02}, {-0.02}, {0.1}, {-0.1}, {0.5}, {-0.5}});
  out->Add("latency", {{0, 0, 3}}, {{0.02, 0}, {0.1, 0}, {0.5, 0}});
  out->Add("filter_delay", {{0, 0.002, 3, true}}, {{0.02}, {0.1}, {0.4}});
}

std::vector<Candidate> CandidatesOf(const SensorDescription& sensor, const Quantities& predicted,
                                    bool poses_were_measured) {
  CandidateList out(sensor.name, EffectTarget::kImu, sensor.effects, SensorMechanisms());
  AddStatic(&out);
  AddDirections(&out);
  if (IsAtRest(predicted)) return out.Take();
  AddScale(predicted, &out);
  AddPlace(&out);
  AddTiming(&out);
  std::vector<Candidate> candidates = out.Take();
  if (poses_were_measured) {
    candidates.insert(candidates.begin(), PoseLatencyCandidate());
    candidates.push_back(MapTiltCandidate());
  }
  return candidates;
}

/// Effects of a unit, relative to poses with a latency. The unit's clock then appears to be behind.
Effects WithPoseLatency(Effects effects, double late_s) {
  if (late_s == 0) return effects;
  const auto own = std::find_if(effects.begin(), effects.end(), [](const Effect& effect) {
    return effect.mechanism->id == "clock_offset";
  });
  if (own != effects.end()) {
    own->values.front() -= late_s;
    return effects;
  }
  effects.push_back({&SensorMechanism("clock_offset", EffectTarget::kImu), {-late_s}});
  return effects;
}

/// Splits samples into quantities. Forces are relative to `mean_f_S_mps2`.
Quantities Split(const std::vector<ImuSample>& samples, const Vec3& mean_f_S_mps2) {
  Quantities split;
  for (const ImuSample& sample : samples) {
    const Vec3 f_S_mps2 = sample.f_S_mps2 - mean_f_S_mps2;
    for (int i = 0; i < 3; ++i) {
      split[static_cast<std::size_t>(i)].push_back(sample.w_WS_S_radps[i]);
      split[static_cast<std::size_t>(i) + 3].push_back(f_S_mps2[i]);
    }
  }
  return split;
}

/// Columns: all predicted quantities at several lags, products and changes of the rates, and time.
Eigen::MatrixXd FlexibleRegressor(const Quantities& predicted) {
  const std::size_t rows = predicted[0].size();
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(rows),
                          static_cast<Eigen::Index>(kQuantities * kImuLags.size() + 6 + 3 + 2));
  for (std::size_t k = 0; k < rows; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    Eigen::Index c = 0;
    for (const std::size_t lag : kImuLags) {
      for (const auto& quantity : predicted) columns(row, c++) = quantity[k >= lag ? k - lag : 0];
    }
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = a; b < 3; ++b) columns(row, c++) = predicted[a][k] * predicted[b][k];
    }
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t next = std::min(k + 1, rows - 1), before = k == 0 ? 0 : k - 1;
      columns(row, c++) = predicted[a][next] - predicted[a][before];
    }
    const double t = static_cast<double>(k) / static_cast<double>(rows);
    columns(row, c++) = t;
    columns(row, c++) = t * t;
  }
  return columns;
}

/// Adds columns for a tilted map: cosine and sine of the heading.
void AddHeading(const ImuLog& log, Eigen::MatrixXd* columns) {
  const Eigen::Index first = columns->cols();
  columns->conservativeResize(Eigen::NoChange, first + 2);
  for (Eigen::Index k = 0; k < columns->rows(); ++k) {
    const Pose& X_WL = log.track.X_WL[2 * static_cast<std::size_t>(k) + 1];
    const double yaw_rad = RpyFromRotation(X_WL.linear()).z();
    (*columns)(k, first) = std::cos(yaw_rad);
    (*columns)(k, first + 1) = std::sin(yaw_rad);
  }
}

std::vector<RegimeVariable> VariablesOf(const Quantities& predicted, const ImuLog& log,
                                        double period_s) {
  std::vector<RegimeVariable> variables;
  const auto add = [&](const std::string& name, std::vector<double> values) {
    variables.push_back({name, WholeSeries(period_s, std::move(values))});
  };
  for (std::size_t i = 0; i < kQuantities; ++i) {
    add((i < 3 ? "rate/" : "force/") + std::string(1, "xyz"[i % 3]), predicted[i]);
  }
  std::vector<double> yaw_rad, roll_rad, pitch_rad, time_s;
  for (std::size_t k = 0; k < predicted[0].size(); ++k) {
    const Vec3 rpy_rad = RpyFromRotation(log.track.X_WL[2 * k + 1].linear());
    roll_rad.push_back(rpy_rad.x());
    pitch_rad.push_back(rpy_rad.y());
    yaw_rad.push_back(rpy_rad.z());
    time_s.push_back(static_cast<double>(k) * period_s);
  }
  variables.push_back({"yaw", WholeSeries(period_s, std::move(yaw_rad)), true});
  add("roll", std::move(roll_rad));
  add("pitch", std::move(pitch_rad));
  add("time", std::move(time_s));
  return variables;
}

/// Rates about the three axes, each divided by its maximum, as commands that separate manoeuvres.
/// At rest, one command covers the whole recording.
std::vector<Series> CommandsOf(const Quantities& predicted, double period_s) {
  if (IsAtRest(predicted)) {
    return {WholeSeries(period_s, std::vector<double>(predicted[0].size(), 1.0))};
  }
  std::vector<Series> commands;
  for (std::size_t a = 0; a < 3; ++a) {
    double largest = kLeastLinkTurning_radps;
    for (const double w : predicted[a]) largest = std::max(largest, std::abs(w));
    std::vector<double> share;
    for (const double w : predicted[a]) share.push_back(w / largest);
    commands.push_back(WholeSeries(period_s, std::move(share)));
  }
  return commands;
}

}  // namespace

std::optional<ReplayBlock> MakeImuBlock(const SensorDescription& sensor, ImuLog given,
                                        const std::string& channel, bool poses_were_measured) {
  if (std::count(given.known.begin(), given.known.end(), true) < kFewestImuIntervals) return {};
  // The replay shares ownership of all three.
  const auto log = std::make_shared<const ImuLog>(std::move(given));
  const auto described = std::make_shared<const SensorDescription>(sensor);
  const auto replay = std::make_shared<const ImuReplay>(*described, *log);
  const double period_s = ToSeconds(log->clock.Period());
  const std::vector<ImuSample> as_documented = replay->Predict(sensor.effects);
  Vec3 mean_f_S_mps2 = Vec3::Zero();
  for (const ImuSample& sample : as_documented) {
    mean_f_S_mps2 += sample.f_S_mps2 / static_cast<double>(as_documented.size());
  }
  const Quantities predicted = Split(as_documented, mean_f_S_mps2);
  std::vector<ImuSample> samples(log->known.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k].w_WS_S_radps = log->w_S_radps[k];
    samples[k].f_S_mps2 = log->f_S_mps2[k];
  }
  Quantities measured = Split(samples, mean_f_S_mps2);

  ReplayBlock block;
  block.name = channel;
  block.first_ns = log->clock.Due(1);
  Eigen::MatrixXd flexible_regressor = FlexibleRegressor(predicted);
  if (poses_were_measured) AddHeading(*log, &flexible_regressor);
  const Mask valid(log->known.begin(), log->known.end());
  for (std::size_t i = 0; i < kQuantities; ++i) {
    const bool is_rate = i < 3;
    block.channels.push_back({channel + "/" + kColumns[i],
                              is_rate ? "rad/s" : "m/s^2",
                              {period_s, std::move(measured[i]), valid},
                              {.offset = is_rate ? 1e-6 : 1e-5, .gain = 1e-5, .delay_s = 0.002},
                              VariablesOf(predicted, *log, period_s),
                              flexible_regressor,
                              {}});
  }
  block.commands = CommandsOf(predicted, period_s);
  block.candidates = CandidatesOf(sensor, predicted, poses_were_measured);
  block.replay = WholeReplay([described, log, replay, mean_f_S_mps2](const Structure& terms) {
    const Effects effects = WithPoseLatency(WithTerms(described->effects, WithoutPoseTerms(terms)),
                                            PoseLatency_s(terms));
    Quantities split = Split(replay->Predict(effects, MapTilt(terms)), mean_f_S_mps2);
    return std::vector<std::vector<double>>(std::make_move_iterator(split.begin()),
                                            std::make_move_iterator(split.end()));
  });
  return block;
}

}  // namespace tera
