#pragma once

#include <vector>

#include "diagnose/diagnosis_input.h"
#include "diagnose/motion/starting_motion.h"

namespace tera {

/// Travel from the encoders of all running gears, in seconds since `zero_ns`. Empty if a gear has
/// no encoder.
std::vector<TravelWindow> GearTravel(const DiagnosisInput& input, const Measurements& measured,
                                     TimeNs zero_ns);

}  // namespace tera
