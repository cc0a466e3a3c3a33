#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/diagnosis_input.h"
#include "diagnose/motion/starting_motion.h"

/// Windows of 0.1 s in which a part stands still by its lever, in seconds from `zero_ns`.
///
/// Model   a part with a recorded lever rests where the lever has been within 0.02 of neutral for 2
///         s. 0.02 is the expected dead band; 2 s is longer than a drive follows its lever. The
///         lever stays there until half a second after the window, since the oil is then shut in.
///         Windows in which an unmeasured part turns do not count. There a unit's mean rate over a
///         second about the window exceeds the encoders' rates of all joints before it by 0.15
///         rad/s. A base rocks with 0.05 rad/s.
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
