#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/replay/axis_log.h"
#include "diagnose/replay/pose_times.h"
#include "physics/traction/track_kinematics.h"

namespace tera {

/// Interval for comparing the motion of base and inertial units.
inline constexpr double kBaseInterval_s = 0.2;

/// Rates of tracks or wheels in one step of time, and the attitude of the base.
struct BaseInstant {
  std::vector<double> gear_rate_radps;  ///< one per running gear
  Mat3 R_WB = Mat3::Identity();
  /// Turning centre at the measured joint positions (turning_centre.h).
  Vec2 turning_centre_m = Vec2::Zero();
};

/// Motion of the base between two measured poses.
struct BaseInterval {
  TimeNs from_ns = 0, to_ns = 0;  ///< stamps of the poses
  TimeNs measured_from_ns = 0,
         measured_to_ns = 0;         ///< true times of measurement, if stamps are times of arrival
  PlanarTwist twist;                 ///< mean over the interval, from the poses and their stamps
  std::size_t first = 0, count = 0;  ///< its instants, at least one
};

/// Motion of a machine's running gear and base: the input to the replay of the ground.
///
/// Frames  B root link. Twists are those of the middle of the contact area. Forward and left refer
///         to the heading half-way through the interval; yaw is about the vertical.
/// Model   Gear rates are means over a step, computed from the gears' angles. If the angles
///         contradict the measured rates, the rates are used, linear between samples. Attitudes are
///         those of the nearest pose. Instant k is the middle of step k. Poses more than a second
///         apart bound no interval, because the path between them is unknown.
/// Omits   Ground forces on bucket and blade. Attitudes and discrepancy corrections keep the
///         stamps' times, even if these are times of arrival.
struct BaseLog {
  static constexpr TimeNs kStep_ns = 50'000'000;  ///< gear rates change little in this time

  TimeNs start_ns = 0;
  std::vector<BaseInstant> instants;
  std::vector<BaseInterval> intervals;
  bool may_be_arrivals = false;  ///< true if the poses' stamps may be times of arrival
};

/// True if all running gears and the base's poses have a common time, as MakeBaseLog requires.
/// Throws InputError if a running gear has no encoder.
bool HaveCommonTime(const MachineModel& model, const std::vector<NamedEncoders>& encoders,
                    const std::vector<TruthPose>& poses);

/// Makes the log. Joints without an encoder keep the model's initial positions. `interval_s` is the
/// least length of an interval; noise would dominate shorter ones. `arrivals` has the poses' times
/// of measurement, if their stamps are times of arrival. Throws InputError if running gears and
/// poses have no common time, or if a running gear has no encoder.
BaseLog MakeBaseLog(const MachineModel& model, const std::vector<NamedEncoders>& encoders,
                    const std::vector<TruthPose>& poses, double interval_s,
                    const std::optional<PoseTimes>& arrivals = {});

}  // namespace tera
