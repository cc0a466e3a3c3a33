#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/replay/axis_log.h"
#include "physics/slots/track_kinematics.h"

namespace tera {

/// What tracks or wheels did at one instant, and how the base stood.
struct BaseInstant {
  std::vector<double> gear_rate_radps;  ///< one for each gear
  Mat3 R_WB = Mat3::Identity();
};

/// How far the base went between two of its measured poses, and what drove it.
struct BaseInterval {
  TimeNs from_ns = 0, to_ns = 0;
  PlanarTwist twist;                 ///< mean, as the poses tell it
  std::size_t first = 0, count = 0;  ///< instants in it, evenly spread
};

/// Running gear and base of one machine over time: what the ground is replayed over.
///
/// Frames  B root link. The twist is that of the middle of the contact with the ground, forward and
///         left of the heading half-way, and about B's z axis.
/// Model   Rates are straight between samples, attitudes those of the nearer pose. Poses that are
///         far apart in time say nothing of what was in between: they bound no interval.
/// Omits   the ground's forces on bucket and blade.
struct BaseLog {
  std::vector<BaseInstant> instants;
  std::vector<BaseInterval> intervals;
};

/// Throws InputError where gears and poses have no time in common, or the encoders lack a gear.
/// `interval_s` is the least length of an interval: shorter ones hold more noise than motion.
BaseLog MakeBaseLog(const MachineModel& model, const std::vector<NamedEncoders>& encoders,
                    const std::vector<TruthPose>& poses, double interval_s);

}  // namespace tera
