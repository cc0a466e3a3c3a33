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
  std::vector<double> gear_rate_radps;  ///< one for each gear
  Mat3 R_WB = Mat3::Identity();
  Vec2 turning_centre_m = Vec2::Zero();  ///< turning_centre.h, at the measured joint positions
};

/// The motion of the base between two of its measured poses.
struct BaseInterval {
  TimeNs from_ns = 0, to_ns = 0;  ///< stamps of the poses
  TimeNs measured_from_ns = 0,
         measured_to_ns = 0;         ///< times of measurement, if the stamps are arrivals
  PlanarTwist twist;                 ///< mean, by the poses and their stamps
  std::size_t first = 0, count = 0;  ///< its instants, at least one
};

/// Motion of one machine's running gear and base over time, input to the replay of the ground.
///
/// Frames  B root link. The twist is that of the middle of the contact with the ground, forward and
///         left of the heading half-way, and about B's z axis.
/// Model   rates are means over a step from the gears' angles; where these contradict the rates,
///         they are interpolated linearly between samples. Attitudes are those of the nearer pose.
///         Instant k is the middle of step k. Poses far apart in time do not determine the path
///         between them and bound no interval.
/// Omits   the ground's forces on bucket and blade. Attitudes, and corrections for a replay's
///         discrepancy, keep the stamps' times, even if these are arrivals.
struct BaseLog {
  static constexpr TimeNs kStep_ns = 50'000'000;  ///< rates of gears change little in it

  TimeNs start_ns = 0;
  std::vector<BaseInstant> instants;
  std::vector<BaseInterval> intervals;
  bool may_be_arrivals = false;  ///< the stamps of poses
};

/// Whether all gears and the base's poses are known at some common time, as MakeBaseLog requires.
/// Throws InputError where the encoders lack a gear.
bool HaveCommonTime(const MachineModel& model, const std::vector<NamedEncoders>& encoders,
                    const std::vector<TruthPose>& poses);

/// Joints without encoder keep the model's initial positions. Throws InputError where gears and
/// poses have no common time, or the encoders lack a gear. `interval_s` is the least length of an
/// interval; noise would dominate shorter ones. `arrivals` has the poses' times of measurement, if
/// their stamps are arrivals.
BaseLog MakeBaseLog(const MachineModel& model, const std::vector<NamedEncoders>& encoders,
                    const std::vector<TruthPose>& poses, double interval_s,
                    const std::optional<PoseTimes>& arrivals = {});

}  // namespace tera
