#pragma once

#include <string>
#include <vector>

#include "diagnose/replay/link_track.h"
#include "sensors/sensor.h"

namespace tera {

/// What an inertial unit measured, and how the link that it sits on moved.
///
/// Frames  S as documented; both quantities expressed in it.
/// Model   turn rates are means over even intervals; interval k >= 1 ends at clock.Due(k) and is
///         entry k - 1. Specific forces are smoothed as the replay, which knows the motion at the
///         track's steps alone, smooths them: in W, by a trapezoid over three steps, and turned
///         into S again.
struct ImuLog {
  SampleClock clock;
  LinkTrack track;  ///< two steps an interval: what forces are told from
  LinkTrack turns;  ///< eight: turn rates add up to how far it turned, however fine
  std::vector<Vec3> w_S_radps, f_S_mps2;
  std::vector<bool> known;  ///< both sides are
};

/// Intervals over which forces can be told from poses that are themselves measured.
///
/// Model   poses half an interval apart, of noise sigma along each axis, give accelerations of
///         noise sqrt(6) sigma / (T/2)^2: the shortest T with at most 0.05 m/s^2. Sigma by the
///         robust scale of the third differences of positions, over sqrt(20).
/// Omits   noise of poses that is slower than their steps. 0 s where there are hardly any poses.
double ImuInterval_s(const std::vector<TruthPose>& poses);

/// No intervals where the track is empty or the unit measured nothing meanwhile.
ImuLog MakeImuLog(const MachineModel& model, const SensorDescription& sensor,
                  const std::vector<ImuSample>& samples, const std::vector<NamedEncoders>& encoders,
                  const std::vector<TruthPose>& poses, double interval_s);

/// An inertial unit carried along a measured motion.
///
/// Model   the simulator's own Imu without noise, its documented bias included, at its true mount,
///         then ImuSlots; what gets another time stamp is read between stamps. Its turn rates are
///         those of the finer track. The Imu runs four times, when this is made: where the unit is
///         documented, and a metre from there along each axis of its link. Its specific force is
///         linear in its place and everything turns with it, so that these tell what it measures
///         anywhere. Errors that are linear act on the means over intervals at once, the others on
///         eight samples an interval.
/// Omits   motion faster than the intervals; the errors that draw random numbers (`outliers`,
///         jitter of `latency`) act, but as drawn here.
class ImuReplay {
 public:
  /// Both must outlive it.
  ImuReplay(const SensorDescription& sensor, const ImuLog& log);

  /// Samples at the ends of the log's intervals, with `effects` in place of the sensor's own;
  /// `R_WL` turns the level's axes into those of a map W that leans.
  std::vector<ImuSample> Predict(const Effects& effects, const Mat3& R_WL = Mat3::Identity()) const;

 private:
  const SensorDescription& sensor_;
  const ImuLog& log_;
  /// Samples of an ideal unit where it is documented.
  struct Carried {
    std::int64_t an_interval = 1;
    std::vector<ImuSample> samples;
    std::vector<Mat3> f_by_place_1ps2;  ///< change of the force in S by the place in the link
    std::vector<Mat3> R_WS;             ///< of it as documented
  };
  Carried fine_;
  Carried means_;  ///< over intervals: enough for what neither bends nor delays
};

}  // namespace tera
