#include "diagnose/replay/imu_replay.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/units.h"
#include "diagnose/statistics/series/robust.h"
#include "sensors/imu/imu_slots.h"
#include "sensors/slots/true_mount.h"

namespace tera {
namespace {

constexpr int kStepsPerInterval = 2;
/// Several, because a clock error may be shorter than an interval.
constexpr int kSamplesPerInterval = 8;
constexpr double kForceNoise_mps2 = 0.05;  ///< upper limit for forces derived from poses
/// Least number of samples of a usable mean, over the number in the fullest interval.
constexpr double kLeastSampleShare = 0.5;

/// Smooths measured forces as the replay smooths those of an ideal unit. The unit is mounted with
/// `R_LS`. The replay derives forces from velocities that are means over the track's steps. For
/// each step, the result is the mean force in W under a trapezoid: weight 1 within half a step of
/// its middle, falling to 0 at 1.5 steps.
class ForcesOfSteps {
 public:
  ForcesOfSteps(const LinkTrack& track, const Mat3& R_LS, TimeNs sample_ns)
      : track_(track),
        R_LS_(R_LS),
        sample_ns_(sample_ns),
        sums_W_mps2_(track.X_WL.size() - 1, Vec3::Zero()),
        weights_(track.X_WL.size() - 1, 0) {}

  void Add(const ImuSample& sample) {
    const TimeNs middle_ns = sample.t_ns - sample_ns_ / 2;
    const Vec3 f_W_mps2 = track_.At(middle_ns).linear() * (R_LS_ * sample.f_S_mps2);
    const double at = ToSeconds(middle_ns - track_.start_ns) / ToSeconds(track_.step_ns);
    const auto own = static_cast<std::ptrdiff_t>(std::floor(at));
    for (std::ptrdiff_t step = own - 1; step <= own + 1; ++step) {
      if (step < 0 || step >= static_cast<std::ptrdiff_t>(weights_.size())) continue;
      const double from_middle = std::abs(at - (static_cast<double>(step) + 0.5));
      const double weight = std::clamp(1.5 - from_middle, 0.0, 1.0);
      sums_W_mps2_[static_cast<std::size_t>(step)] += weight * f_W_mps2;
      weights_[static_cast<std::size_t>(step)] += weight;
    }
  }

  /// Mean over an interval, in S. Returns nothing if a step has less than half of the usual
  /// samples.
  std::optional<Vec3> MeanOver_S_mps2(std::size_t interval) const {
    const double least = kLeastSampleShare * *std::max_element(weights_.begin(), weights_.end());
    Vec3 mean_mps2 = Vec3::Zero();
    for (std::size_t k = interval * kStepsPerInterval; k < (interval + 1) * kStepsPerInterval;
         ++k) {
      if (weights_[k] == 0 || weights_[k] < least) return std::nullopt;
      const Mat3 R_WS = track_.At(track_.t_ns(k) + track_.step_ns / 2).linear() * R_LS_;
      mean_mps2 += R_WS.transpose() * sums_W_mps2_[k] / (weights_[k] * kStepsPerInterval);
    }
    return mean_mps2;
  }

 private:
  const LinkTrack& track_;
  const Mat3 R_LS_;
  const TimeNs sample_ns_;
  std::vector<Vec3> sums_W_mps2_;
  std::vector<double> weights_;
};

TimeNs UsualPeriod(const std::vector<ImuSample>& samples) {
  std::vector<double> periods_s;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    periods_s.push_back(ToSeconds(samples[k].t_ns - samples[k - 1].t_ns));
  }
  return periods_s.empty() ? 0 : FromSeconds(Median(periods_s));
}

/// Sets the measured means of each interval.
void SetMeasured(const std::vector<ImuSample>& samples, const Mat3& R_LS, ImuLog* log) {
  const std::size_t intervals = (log->track.X_WL.size() - 1) / kStepsPerInterval;
  log->w_S_radps.assign(intervals, Vec3::Zero());
  log->f_S_mps2.assign(intervals, Vec3::Zero());
  std::vector<double> count(intervals, 0.0);
  ForcesOfSteps forces(log->track, R_LS, UsualPeriod(samples));
  for (const ImuSample& sample : samples) {
    forces.Add(sample);
    const TimeNs since_ns = sample.t_ns - log->clock.start_ns;
    if (since_ns <= 0) continue;
    const auto k = static_cast<std::size_t>((since_ns - 1) / log->clock.Period());
    if (k >= intervals) continue;
    log->w_S_radps[k] += sample.w_WS_S_radps;
    ++count[k];
  }
  const double usual = intervals == 0 ? 0 : *std::max_element(count.begin(), count.end());
  for (std::size_t k = 0; k < intervals; ++k) {
    const auto step = static_cast<std::ptrdiff_t>(k * kStepsPerInterval);
    const auto known = log->track.known.begin() + step;
    log->known.push_back(
        count[k] > 0 && count[k] >= kLeastSampleShare * usual &&
        std::all_of(known, known + kStepsPerInterval + 1, [](bool b) { return b; }));
    if (count[k] == 0) continue;
    log->w_S_radps[k] /= count[k];
    const std::optional<Vec3> force_mps2 = forces.MeanOver_S_mps2(k);
    log->known[k] = log->known[k] && force_mps2.has_value();
    log->f_S_mps2[k] = force_mps2.value_or(Vec3::Zero());
  }
}

/// Interpolates samples at ascending times. Beyond the ends, the first or last sample holds.
class ReadBetween {
 public:
  explicit ReadBetween(const std::vector<ImuSample>& samples) : samples_(samples) {}

  ImuSample At(TimeNs t_ns) {
    while (next_ < samples_.size() && samples_[next_].t_ns < t_ns) ++next_;
    if (next_ == samples_.size()) return samples_.back();
    const ImuSample& b = samples_[next_];
    if (next_ == 0 || b.t_ns == t_ns) return b;
    const ImuSample& a = samples_[next_ - 1];
    const double s = ToSeconds(t_ns - a.t_ns) / ToSeconds(b.t_ns - a.t_ns);
    return {t_ns, t_ns, (1 - s) * a.w_WS_S_radps + s * b.w_WS_S_radps,
            (1 - s) * a.f_S_mps2 + s * b.f_S_mps2};
  }

 private:
  const std::vector<ImuSample>& samples_;
  std::size_t next_ = 0;
};

/// Mean of interval `k`, counted from 0. The interval includes its end.
ImuSample MeanOver(std::int64_t k, std::int64_t an_interval, const SampleClock& clock,
                   ReadBetween* samples) {
  ImuSample mean;
  const auto share = 1 / static_cast<double>(an_interval);
  for (std::int64_t i = 1; i <= an_interval; ++i) {
    const TimeNs t_ns = clock.Due(k * an_interval + i);
    const ImuSample sample = samples->At(t_ns);
    mean.t_ns = mean.t_available_ns = t_ns;
    mean.w_WS_S_radps += share * sample.w_WS_S_radps;
    mean.f_S_mps2 += share * sample.f_S_mps2;
  }
  return mean;
}

SampleClock ClockOf(const ImuLog& log, std::int64_t an_interval) {
  return {static_cast<double>(an_interval) * log.clock.rate_hz, log.clock.start_ns};
}

/// True if all effects are linear in the measurement, so that they may act on means.
bool AreLinear(const Effects& effects) {
  return std::all_of(effects.begin(), effects.end(), [](const Effect& effect) {
    const std::string_view id = effect.mechanism->id;
    return effect.mechanism->slot == Slot::kSensorGeometry || id == "bias" || id == "scale" ||
           id == "temperature_drift";
  });
}

/// Sets each sample's turn rate to that of the track's preceding step, for a unit mounted with
/// `R_LS`.
void SetTurns(const LinkTrack& turns, const Mat3& R_LS, std::vector<ImuSample>* samples) {
  for (ImuSample& sample : *samples) {
    const Mat3 R_WA = turns.At(sample.t_ns - turns.step_ns).linear();
    const Eigen::AngleAxisd turn(R_WA.transpose() * turns.At(sample.t_ns).linear());
    sample.w_WS_S_radps =
        R_LS.transpose() * turn.axis() * (turn.angle() / ToSeconds(turns.step_ns));
  }
}

/// Samples that an ideal unit at the mount `X_BS` measures.
std::vector<ImuSample> Ideal(const ImuLog& log, const Pose& X_BS) {
  Imu imu({}, X_BS, ClockOf(log, kSamplesPerInterval), 0, 0, "");
  const Vec3 gravity_W_mps2(0, 0, -kStandardGravity_mps2);
  std::vector<ImuSample> samples;
  BodyState begin, end;
  for (std::size_t k = 0; k + 1 < log.track.X_WL.size(); ++k) {
    begin.X_WB = log.track.X_WL[k];
    end.X_WB = log.track.X_WL[k + 1];
    imu.Advance(log.track.t_ns(k), begin, log.track.t_ns(k + 1), end, gravity_W_mps2, &samples);
  }
  imu.Finish(&samples);
  return samples;
}

}  // namespace

double ImuInterval_s(const std::vector<TruthPose>& poses) {
  double sigma_m = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto p_m = [&](std::size_t k) { return poses[k].X_WB.translation()[axis]; };
    std::vector<double> differences;
    for (std::size_t k = 3; k < poses.size(); ++k) {
      differences.push_back(p_m(k) - 3 * p_m(k - 1) + 3 * p_m(k - 2) - p_m(k - 3));
    }
    if (differences.empty()) return 0;
    sigma_m = std::max(sigma_m, RobustScale(differences) / std::sqrt(20.0));
  }
  return 2 * std::sqrt(std::sqrt(6.0) * sigma_m / kForceNoise_mps2);
}

ImuLog MakeImuLog(const MachineModel& model, const SensorDescription& sensor,
                  const std::vector<ImuSample>& samples, const std::vector<NamedEncoders>& encoders,
                  const std::vector<TruthPose>& poses, double interval_s) {
  ImuLog log;
  const int link = model.LinkIndex(sensor.link);
  if (samples.empty() || link < 0) return log;
  const TimeNs from_ns =
      poses.empty() ? samples.front().t_ns : std::max(samples.front().t_ns, poses.front().t_ns);
  const TimeNs to_ns =
      poses.empty() ? samples.back().t_ns : std::min(samples.back().t_ns, poses.back().t_ns);
  const TimeNs sample_ns = FromSeconds(interval_s / kSamplesPerInterval);
  const TimeNs step_ns = kSamplesPerInterval / kStepsPerInterval * sample_ns;
  log.clock = {1e9 / static_cast<double>(kStepsPerInterval * step_ns), from_ns};
  log.track = TrackOfLink(model, encoders, poses, link, from_ns, to_ns, step_ns);
  log.turns = TrackOfLink(model, encoders, poses, link, from_ns, to_ns, sample_ns);
  if (log.track.X_WL.size() > kStepsPerInterval) SetMeasured(samples, sensor.X_BS.linear(), &log);
  return log;
}

ImuReplay::ImuReplay(const SensorDescription& sensor, const ImuLog& log)
    : sensor_(sensor), log_(log), fine_{kSamplesPerInterval, Ideal(log, sensor.X_BS), {}, {}} {
  const Mat3 R_LS = sensor.X_BS.linear();
  SetTurns(log.turns, R_LS, &fine_.samples);
  for (const ImuSample& sample : fine_.samples) {
    fine_.R_WS.push_back(log.track.At(sample.t_ns).linear() * R_LS);
  }
  fine_.f_by_place_1ps2.resize(fine_.samples.size());
  for (int axis = 0; axis < 3; ++axis) {
    Pose X_BS = sensor.X_BS;
    X_BS.translation()[axis] += 1;
    const std::vector<ImuSample> beside = Ideal(log, X_BS);
    for (std::size_t k = 0; k < beside.size(); ++k) {
      fine_.f_by_place_1ps2[k].col(axis) = beside[k].f_S_mps2 - fine_.samples[k].f_S_mps2;
    }
  }
  ReadBetween between(fine_.samples);
  const SampleClock clock = ClockOf(log, kSamplesPerInterval);
  for (std::size_t k = 0; k < log.known.size(); ++k) {
    means_.samples.push_back(
        MeanOver(static_cast<std::int64_t>(k), kSamplesPerInterval, clock, &between));
    Mat3 f_by_place_1ps2 = Mat3::Zero();
    for (std::size_t i = 0; i < kSamplesPerInterval; ++i) {
      const std::size_t at = std::min(k * kSamplesPerInterval + i, fine_.samples.size() - 1);
      f_by_place_1ps2 += fine_.f_by_place_1ps2[at] / kSamplesPerInterval;
    }
    means_.f_by_place_1ps2.push_back(f_by_place_1ps2);
    means_.R_WS.push_back(log.track.X_WL[kStepsPerInterval * k + 1].linear() * R_LS);
  }
}

std::vector<ImuSample> ImuReplay::Predict(const Effects& effects, const Mat3& R_WL) const {
  const Carried& carried = AreLinear(effects) ? means_ : fine_;
  const Pose X_BT = TrueMount(sensor_.X_BS, effects);
  const Vec3 away_B_m = X_BT.translation() - sensor_.X_BS.translation();
  const Mat3 R_TS = X_BT.linear().transpose() * sensor_.X_BS.linear();
  const auto& model = std::get<ImuModel>(sensor_.model);
  const Vec3 up_mps2(0, 0, kStandardGravity_mps2);
  const Vec3 leans_W_mps2 = R_WL * up_mps2 - up_mps2;
  ImuSlots slots(effects, 0, sensor_.name);
  std::vector<ImuSample> samples = carried.samples;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    ImuSample& sample = samples[k];
    sample.w_WS_S_radps = R_TS * sample.w_WS_S_radps + model.gyro_bias_radps;
    const Vec3 f_S_mps2 = sample.f_S_mps2 + carried.f_by_place_1ps2[k] * away_B_m +
                          carried.R_WS[k].transpose() * leans_W_mps2;
    sample.f_S_mps2 = R_TS * f_S_mps2 + model.accel_bias_mps2;
    slots.Apply(&sample);
  }
  const SampleClock clock = ClockOf(log_, carried.an_interval);
  ReadBetween between(samples);
  std::vector<ImuSample> predicted;
  for (std::size_t k = 0; k < log_.known.size(); ++k) {
    predicted.push_back(
        MeanOver(static_cast<std::int64_t>(k), carried.an_interval, clock, &between));
  }
  return predicted;
}

}  // namespace tera
