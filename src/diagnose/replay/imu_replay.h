#pragma once

#include <string>
#include <vector>

#include "diagnose/replay/link_track.h"
#include "sensors/sensor.h"

namespace tera {

/// Mean measurements of an inertial unit over even intervals, and the motion of its link.
///
/// Frames  S the unit as documented. Turn rates and forces are in S.
/// Model   Interval k >= 1 ends at clock.Due(k) and is entry k - 1. Turn rates are plain means over
///         the interval. Specific forces are smoothed like those of the replay, which knows the
///         motion only at the track's steps. A trapezoid over three steps smooths them in W; the
///         result is rotated back into S.
struct ImuLog {
  SampleClock clock;
  LinkTrack track;  ///< two steps per interval, for forces
  LinkTrack turns;  ///< eight steps per interval, for turn rates
  std::vector<Vec3> w_S_radps, f_S_mps2;
  std::vector<bool> known;  ///< true if both measurement and motion are known
};

/// Shortest interval over which measured poses give usable forces. Returns 0 with fewer than four
/// poses.
///
/// Model   Accelerations come from poses half an interval apart. With pose noise sigma along each
///         axis, the noise of accelerations is sqrt(6) sigma / (T/2)^2. T is the shortest interval
///         at which this noise is at most 0.05 m/s^2. Sigma is the robust scale of the third
///         differences of positions, over sqrt(20).
/// Omits   Pose noise that is slower than a few pose periods.
double ImuInterval_s(const std::vector<TruthPose>& poses);

/// Makes the log of a unit. The log has no intervals if the link's track is empty, or if the unit
/// has no samples during the track.
ImuLog MakeImuLog(const MachineModel& model, const SensorDescription& sensor,
                  const std::vector<ImuSample>& samples, const std::vector<NamedEncoders>& encoders,
                  const std::vector<TruthPose>& poses, double interval_s);

/// Predicts the samples of an inertial unit along a measured motion.
///
/// Model   The simulator's Imu without noise, with its documented bias, at its true mount, followed
///         by ImuSlots. Where effects change the stamps, samples are interpolated between them.
///         Turn rates come from the finer track.
///         The constructor runs the Imu four times: at the documented position, and one metre away
///         along each axis of the link. Specific force is linear in position, and rotating the unit
///         rotates its measurements. Therefore the four runs give the measurements at any mount.
///         Linear effects act on means over intervals, all others on eight samples per interval.
/// Omits   Motion faster than the intervals. Random errors (`outliers`, jitter of `latency`) act
///         with other draws than in the recording.
class ImuReplay {
 public:
  /// `sensor` and `log` must outlive this object.
  ImuReplay(const SensorDescription& sensor, const ImuLog& log);

  /// Samples at the ends of the log's intervals, with `effects` in place of the sensor's. `R_WL` is
  /// the attitude of the level frame L in a tilted map W.
  std::vector<ImuSample> Predict(const Effects& effects, const Mat3& R_WL = Mat3::Identity()) const;

 private:
  const SensorDescription& sensor_;
  const ImuLog& log_;
  /// Samples of an ideal unit at its documented mount, and their derivatives.
  struct Carried {
    std::int64_t an_interval = 1;
    std::vector<ImuSample> samples;
    /// Derivative of the specific force in S by position in the link.
    std::vector<Mat3> f_by_place_1ps2;
    std::vector<Mat3> R_WS;  ///< attitude of the documented unit
  };
  Carried fine_;
  Carried means_;  ///< means over intervals, used for linear effects
};

}  // namespace tera
