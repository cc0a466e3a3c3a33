#include "diagnose/replay/imu_replay.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "sensors/slots/sensor_slots.h"
#include "sensors/slots/true_mount.h"

namespace tera {
namespace {

constexpr int kStepsAnInterval = 2;
constexpr int kSamplesAnInterval = 8;  ///< so that a clock may be off by less than an interval
constexpr double kLeastShare = 0.5;    ///< of the samples that an interval usually has

/// Means of the samples in each interval.
void SetMeasured(const std::vector<ImuSample>& samples, ImuLog* log) {
  const std::size_t intervals = (log->track.X_WL.size() - 1) / kStepsAnInterval;
  log->w_S_radps.assign(intervals, Vec3::Zero());
  log->f_S_mps2.assign(intervals, Vec3::Zero());
  std::vector<double> count(intervals, 0.0);
  for (const ImuSample& sample : samples) {
    const TimeNs since_ns = sample.t_ns - log->clock.start_ns;
    if (since_ns <= 0) continue;
    const auto k = static_cast<std::size_t>((since_ns - 1) / log->clock.Period());
    if (k >= intervals) break;
    log->w_S_radps[k] += sample.w_WS_S_radps;
    log->f_S_mps2[k] += sample.f_S_mps2;
    ++count[k];
  }
  const double usual = intervals == 0 ? 0 : *std::max_element(count.begin(), count.end());
  for (std::size_t k = 0; k < intervals; ++k) {
    const auto step = static_cast<std::ptrdiff_t>(k * kStepsAnInterval);
    const auto known = log->track.known.begin() + step;
    log->known.push_back(
        count[k] > 0 && count[k] >= kLeastShare * usual &&
        std::all_of(known, known + kStepsAnInterval + 1, [](bool b) { return b; }));
    if (count[k] == 0) continue;
    log->w_S_radps[k] /= count[k];
    log->f_S_mps2[k] /= count[k];
  }
}

/// Between the stamps of two samples; beyond the first and the last, those.
ImuSample At(const std::vector<ImuSample>& samples, TimeNs t_ns) {
  const auto next = std::lower_bound(samples.begin(), samples.end(), t_ns,
                                     [](const ImuSample& s, TimeNs t) { return s.t_ns < t; });
  if (next == samples.begin()) return samples.front();
  if (next == samples.end()) return samples.back();
  const ImuSample &b = *next, &a = *(next - 1);
  const double s = ToSeconds(t_ns - a.t_ns) / ToSeconds(b.t_ns - a.t_ns);
  return {t_ns, t_ns, (1 - s) * a.w_WS_S_radps + s * b.w_WS_S_radps,
          (1 - s) * a.f_S_mps2 + s * b.f_S_mps2};
}

/// Of interval `k`, counted from 0, that ends with its last sample.
ImuSample MeanOver(std::int64_t k, const SampleClock& fine, const std::vector<ImuSample>& samples) {
  ImuSample mean;
  for (int i = 1; i <= kSamplesAnInterval; ++i) {
    const ImuSample sample = At(samples, fine.Due(k * kSamplesAnInterval + i));
    mean.t_ns = mean.t_available_ns = sample.t_ns;
    mean.w_WS_S_radps += sample.w_WS_S_radps / kSamplesAnInterval;
    mean.f_S_mps2 += sample.f_S_mps2 / kSamplesAnInterval;
  }
  return mean;
}

}  // namespace

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
  const TimeNs step_ns = FromSeconds(interval_s / kStepsAnInterval);
  log.clock = {1e9 / static_cast<double>(kStepsAnInterval * step_ns), from_ns};
  log.track = TrackOfLink(model, encoders, poses, link, from_ns, to_ns, step_ns);
  if (log.track.X_WL.size() > kStepsAnInterval) SetMeasured(samples, &log);
  return log;
}

std::vector<ImuSample> ImuReplay::Predict(const Effects& effects) const {
  const Pose X_BT = TrueMount(sensor_.X_BS, effects);
  const SampleClock fine{kSamplesAnInterval * log_.clock.rate_hz, log_.clock.start_ns};
  const auto& documented = std::get<ImuModel>(sensor_.model);
  Imu imu({.gyro_bias_radps = documented.gyro_bias_radps,
           .accel_bias_mps2 = documented.accel_bias_mps2},
          X_BT, fine, 0, 0, sensor_.name);
  const Vec3 gravity_W_mps2(0, 0, -kStandardGravity_mps2);
  std::vector<ImuSample> samples;
  BodyState begin, end;
  for (std::size_t k = 0; k + 1 < log_.track.X_WL.size(); ++k) {
    begin.X_WB = log_.track.X_WL[k];
    end.X_WB = log_.track.X_WL[k + 1];
    imu.Advance(log_.track.t_ns(k), begin, log_.track.t_ns(k + 1), end, gravity_W_mps2, &samples);
  }
  imu.Finish(&samples);
  ImuSlots slots(effects, 0, sensor_.name);
  for (ImuSample& sample : samples) slots.Apply(&sample);
  std::vector<ImuSample> predicted;
  for (std::size_t k = 0; k < log_.known.size(); ++k) {
    predicted.push_back(MeanOver(static_cast<std::int64_t>(k), fine, samples));
  }
  return predicted;
}

}  // namespace tera
