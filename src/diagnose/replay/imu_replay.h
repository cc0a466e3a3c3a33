#pragma once

#include <string>
#include <vector>

#include "diagnose/replay/link_track.h"
#include "sensors/sensor.h"

namespace tera {

/// Means of an inertial unit's measurements, and the motion of its link.
///
/// Frames  S as documented; both quantities are expressed in it.
/// Model   turn rates are means over even intervals; interval k >= 1 ends at clock.Due(k) and is
///         entry k - 1. Specific forces have the replay's smoothing, since the replay knows the
///         motion only at the track's steps. A trapezoid over three steps smooths them in W; they
///         are then rotated back into S.
struct ImuLog {
  SampleClock clock;
  LinkTrack track;  ///< two steps per interval, source of the forces
  LinkTrack turns;  ///< eight steps per interval, source of the turn rates
  std::vector<Vec3> w_S_radps, f_S_mps2;
  std::vector<bool> known;  ///< whether both measurement and motion are known
};

/// Shortest intervals over which measured poses yield forces; 0 with hardly any poses.
///
/// Model   poses half an interval apart, with noise sigma along each axis, give accelerations with
///         noise sqrt(6) sigma / (T/2)^2. T is the shortest with at most 0.05 m/s^2. Sigma is the
///         robust scale of the third differences of positions, over sqrt(20).
/// Omits   pose noise slower than their steps.
double ImuInterval_s(const std::vector<TruthPose>& poses);

/// The log of a unit, without intervals where the track is empty or the unit measured nothing
/// within it.
ImuLog MakeImuLog(const MachineModel& model, const SensorDescription& sensor,
                  const std::vector<ImuSample>& samples, const std::vector<NamedEncoders>& encoders,
                  const std::vector<TruthPose>& poses, double interval_s);

/// Samples of an inertial unit along a measured motion.
///
/// Model   the simulator's own Imu without noise, with its documented bias, at its true mount, then
///         ImuSlots. Samples with other stamps are interpolated between stamps. Turn rates are
///         those of the finer track. The constructor runs the Imu four times: at its documented
///         position, and a metre away along each axis of its link. Specific force is linear in
///         position, and rotating the unit rotates its measurements, so these four give the
///         measurements at any mount. Linear errors act on the means over intervals, the others on
///         eight samples per interval.
/// Omits   motion faster than the intervals. Random errors (`outliers`, jitter of `latency`) act,
///         but with other draws.
class ImuReplay {
 public:
  /// Both must outlive it.
  ImuReplay(const SensorDescription& sensor, const ImuLog& log);

  /// Samples at the ends of the log's intervals, with `effects` in place of the sensor's own.
  /// `R_WL` is the attitude of the level frame L in a tilted map W.
  std::vector<ImuSample> Predict(const Effects& effects, const Mat3& R_WL = Mat3::Identity()) const;

 private:
  const SensorDescription& sensor_;
  const ImuLog& log_;
  /// Samples of an ideal unit at its documented mount.
  struct Carried {
    std::int64_t an_interval = 1;
    std::vector<ImuSample> samples;
    std::vector<Mat3> f_by_place_1ps2;  ///< derivative of the force in S by the position in the
                                        ///< link
    std::vector<Mat3> R_WS;             ///< attitude of the documented unit
  };
  Carried fine_;
  Carried means_;  ///< over intervals, sufficient for linear errors without delay
};

}  // namespace tera
