#pragma once

#include <string>
#include <vector>

#include "diagnose/replay/link_track.h"
#include "sensors/sensor.h"

namespace tera {

/// The means of what an inertial unit measured, and the motion of its link.
///
/// Frames  S as documented; both quantities expressed in it.
/// Model   turn rates are means over even intervals; interval k >= 1 ends at clock.Due(k) and is
///         entry k - 1. Specific forces are smoothed as the replay smooths them, which knows the
///         motion at the track's steps alone: in W, by a trapezoid over three steps, and turned
///         back into S.
struct ImuLog {
  SampleClock clock;
  LinkTrack track;  ///< two steps an interval, from which forces are derived
  LinkTrack turns;  ///< eight steps an interval, from which turn rates are derived
  std::vector<Vec3> w_S_radps, f_S_mps2;
  std::vector<bool> known;  ///< whether both measurement and motion are known
};

/// The length of intervals over which forces can be derived from measured poses; 0 where there are
/// hardly any poses.
///
/// Model   poses half an interval apart, of noise sigma along each axis, give accelerations of
///         noise sqrt(6) sigma / (T/2)^2: the shortest T with at most 0.05 m/s^2. Sigma by the
///         robust scale of the third differences of positions, over sqrt(20).
/// Omits   noise of poses that is slower than their steps.
double ImuInterval_s(const std::vector<TruthPose>& poses);

/// The log of a unit; it has no intervals where the track is empty or the unit measured nothing
/// meanwhile.
ImuLog MakeImuLog(const MachineModel& model, const SensorDescription& sensor,
                  const std::vector<ImuSample>& samples, const std::vector<NamedEncoders>& encoders,
                  const std::vector<TruthPose>& poses, double interval_s);

/// The samples that an inertial unit would have measured along a measured motion.
///
/// Model   the simulator's own Imu without noise, its documented bias included, at its true mount,
///         then ImuSlots; samples with other time stamps are interpolated between stamps. Turn
///         rates are those of the finer track. The Imu runs four times on construction: at its
///         documented place, and a metre from there along each axis of its link. Its specific force
///         is linear in its place, and rotating the unit rotates its measurements, so that these
///         four give the measurements at any mount. Linear errors act on the means over intervals,
///         the others on eight samples an interval.
/// Omits   motion faster than the intervals; the errors that draw random numbers (`outliers`,
///         jitter of `latency`) act, but as drawn here.
class ImuReplay {
 public:
  /// Both must outlive it.
  ImuReplay(const SensorDescription& sensor, const ImuLog& log);

  /// Samples at the ends of the log's intervals, with `effects` in place of the sensor's own;
  /// `R_WL` is the attitude of the level frame L in a tilted map W.
  std::vector<ImuSample> Predict(const Effects& effects, const Mat3& R_WL = Mat3::Identity()) const;

 private:
  const SensorDescription& sensor_;
  const ImuLog& log_;
  /// Samples of an ideal unit at its documented mount.
  struct Carried {
    std::int64_t an_interval = 1;
    std::vector<ImuSample> samples;
    std::vector<Mat3> f_by_place_1ps2;  ///< change of the force in S by the place in the link
    std::vector<Mat3> R_WS;             ///< attitude of the documented unit
  };
  Carried fine_;
  Carried means_;  ///< over intervals, enough for errors that are linear and do not delay
};

}  // namespace tera
