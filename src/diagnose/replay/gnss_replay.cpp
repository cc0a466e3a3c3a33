#include "diagnose/replay/gnss_replay.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "sensors/gnss/antenna_pair.h"
#include "sensors/gnss/gnss_errors.h"
#include "sensors/gnss/gnss_reflector.h"
#include "sensors/slots/effect_numbers.h"
#include "sensors/slots/low_pass.h"
#include "sensors/slots/true_mount.h"

namespace tera {
namespace {

constexpr TimeNs kStep_ns = 50'000'000;

/// Rank of a fix; better fixes have larger ranks.
int RankOf(GnssFix fix) {
  switch (fix) {
    case GnssFix::kNone:
      return 0;
    case GnssFix::kSingle:
      return 1;
    case GnssFix::kDifferential:
      return 2;
    case GnssFix::kRtkFloat:
      return 3;
    case GnssFix::kRtkFixed:
      return 4;
  }
  return 0;
}

/// Time at which a sample with the stamp `t_ns` was measured. Inverse of ReportClock.
TimeNs MeasuredAt(const Effects& effects, TimeNs t_ns) {
  const double late_s =
      NumberOf(effects, "clock_offset", "offset_s", 0) + NumberOf(effects, "latency", "delay_s", 0);
  const double drift = NumberOf(effects, "clock_drift", "drift_ppm", 0) * 1e-6;
  return std::llround(static_cast<double>(t_ns - FromSeconds(late_s)) / (1 + drift));
}

/// The effects without random ones.
Effects Certain(Effects effects) {
  std::erase_if(effects, [](const Effect& effect) {
    return effect.mechanism->id == "float_jump" || effect.mechanism->id == "outliers";
  });
  return effects;
}

RaisedBoom BoomAt(const ReceiverLog& log, TimeNs t_ns) {
  const Vec3 direction_W =
      log.boom->PointAt(t_ns, log.boom_direction_B) - log.boom->PointAt(t_ns, Vec3::Zero());
  return {direction_W};
}

Antenna AntennaOf(const SensorDescription& receiver, const Effects& effects) {
  return {receiver.link, receiver.X_BS, effects};
}

void AddBoom(const MachineModel& model, int link,
             const std::function<LinkTrack(int link)>& track_of, ReceiverLog* log) {
  const auto reflector = GnssReflectorOf(model, link);
  if (!reflector) return;
  LinkTrack track = track_of(reflector->link);
  if (track.X_WL.size() != log->track.X_WL.size()) return;
  log->boom = std::move(track);
  log->boom_direction_B = reflector->direction_B;
}

}  // namespace

GnssLog MakeGnssLog(const MachineModel& model, const std::vector<SensorDescription>& receivers,
                    const std::vector<std::vector<GnssSample>>& samples,
                    const std::vector<NamedEncoders>& encoders,
                    const std::vector<TruthPose>& poses) {
  GnssLog logs(receivers.size());
  if (poses.empty()) return logs;
  const TimeNs from_ns = poses.front().t_ns, to_ns = poses.back().t_ns;
  const auto track_of = [&](int link) {
    return TrackOfLink(model, encoders, poses, link, from_ns, to_ns, kStep_ns);
  };
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    ReceiverLog& log = logs[r];
    const int link = model.LinkIndex(receivers[r].link);
    if (link < 0) continue;
    log.track = track_of(link);
    if (log.track.X_WL.size() < 2) continue;
    AddBoom(model, link, track_of, &log);
    const int least = RankOf(std::get<GnssModel>(receivers[r].model).fix);
    for (const GnssSample& sample : samples[r]) {
      if (sample.fix == GnssFix::kNone || RankOf(sample.fix) < least) continue;
      if (sample.t_ns < from_ns || sample.t_ns > to_ns) continue;
      const auto k = static_cast<std::size_t>((sample.t_ns - from_ns) / kStep_ns);
      const std::size_t next = std::min(k + 1, log.track.known.size() - 1);
      log.t_ns.push_back(sample.t_ns);
      log.p_WS_m.push_back(sample.enu_m);
      log.known.push_back(log.track.known[std::min(k, next)] && log.track.known[next]);
    }
  }
  return logs;
}

std::vector<Vec3> GnssReplay::Predict(std::size_t r, const std::vector<Effects>& effects) const {
  const SensorDescription& receiver = receivers_[r];
  const ReceiverLog& log = log_[r];
  const Effects own = Certain(effects[r]);
  AntennaPlace place{receiver.link, TrueMount(receiver.X_BS, own)};
  const LinkTrack* track = &log.track;
  if (receivers_.size() == 2) {
    const std::size_t other = 1 - r;
    place = TrueAntenna(AntennaOf(receiver, own), AntennaOf(receivers_[other], effects[other]));
    if (place.link != receiver.link) track = &log_[other].track;
  }
  const Vec3& bias_m = std::get<GnssModel>(receiver.model).bias_enu_m;
  GnssErrors errors(own, 0, receiver.name);
  LowPass filter(own);
  const bool reflects = log.boom && FindEffect(own, "multipath");
  std::vector<Vec3> predicted_m;
  for (std::size_t k = 0; k < log.t_ns.size(); ++k) {
    const TimeNs t_ns = MeasuredAt(own, log.t_ns[k]);
    const auto index = static_cast<std::int64_t>(k);
    const RaisedBoom boom = reflects ? BoomAt(log, t_ns) : RaisedBoom{};
    GnssSample sample;
    sample.t_ns = t_ns;
    sample.fix = GnssFix::kRtkFixed;
    sample.enu_m = track->PointAt(t_ns, place.X_BT.translation()) + bias_m;
    errors.Sense(index, boom, &sample);
    if (filter.present()) sample.enu_m = filter.Next(t_ns, sample.enu_m);
    errors.ReadOut(index, &sample);
    predicted_m.push_back(sample.enu_m);
  }
  return predicted_m;
}

}  // namespace tera
