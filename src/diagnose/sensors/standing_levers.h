#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/diagnosis_input.h"
#include "diagnose/motion/starting_motion.h"

/// Windows of 0.1 s in which a lever keeps a part at rest, in seconds since `zero_ns`.
///
/// Model   a part rests where its recorded lever has stayed within 0.02 of neutral for 2 s, and
///         stays there for another 0.5 s. 0.02 is the expected dead band. 2 s is longer than a
///         drive follows its lever. 0.5 s allows for late stamps of levers. Windows in which an
///         unmeasured part turns are left out: the mean turn rate of a unit over one second about
///         the window exceeds the encoder rates of all joints before it by 0.15 rad/s. A base rocks
///         with 0.05 rad/s.
/// Omits   a machine that slides or is pushed; a machine that drives straight ahead while the
///         recorded levers stay at zero.

namespace tera {

/// Standstill of the base: the levers of all running gears rest. Empty if one of these levers was
/// not recorded.
std::vector<TravelWindow> StandingByLevers(const DiagnosisInput& input,
                                           const Measurements& measured, TimeNs zero_ns);

/// Standstill of a joint. Empty if its lever was not recorded.
std::vector<TravelWindow> RestingByLever(const DiagnosisInput& input, const Measurements& measured,
                                         std::size_t joint, TimeNs zero_ns);

}  // namespace tera
