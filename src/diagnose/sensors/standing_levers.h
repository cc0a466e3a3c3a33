#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/diagnosis_input.h"
#include "diagnose/motion/starting_motion.h"

/// What stands still by its lever, as windows of 0.1 s that are still, in seconds from `zero_ns`.
///
/// Model   what has a lever that was recorded rests where that has been within 0.02 of neutral, the
///         dead band that is as expected, for 2 s, longer than a drive follows its lever, and is so
///         until half a second after the window: oil is shut in then. Not in a window in which
///         something turns that no encoder measures: where a unit turns by more than 0.15 rad/s
///         than all the joints before it that have encoders do together, in the mean over a second
///         about the window. A base rocks with 0.05 rad/s.
/// Omits   a machine that slides or is pushed along, and one that drives straight ahead by levers
///         that were left at zero in a recording.

namespace tera {

/// When the base stands: the levers of all running gears rest. Empty where one was not recorded.
std::vector<TravelWindow> StandingByLevers(const DiagnosisInput& input,
                                           const Measurements& measured, TimeNs zero_ns);

/// When a joint rests. Empty where it has no lever that was recorded.
std::vector<TravelWindow> RestingByLever(const DiagnosisInput& input, const Measurements& measured,
                                         std::size_t joint, TimeNs zero_ns);

}  // namespace tera
