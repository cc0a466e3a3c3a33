#pragma once

#include <vector>

#include "diagnose/diagnosis_input.h"
#include "diagnose/motion/starting_motion.h"

namespace tera {

/// Travel by the encoders of running gear, times in seconds since `zero_ns`. Empty where not each
/// gear has an encoder.
std::vector<TravelWindow> GearTravel(const DiagnosisInput& input, const Measurements& measured,
                                     TimeNs zero_ns);

}  // namespace tera
