#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/diagnosis_input.h"
#include "diagnose/measurements.h"

namespace tera {

/// Joints whose motion is estimated together with the sensors' errors. Such a joint lies between
/// the base and an inertial unit or antenna with samples, is not fixed, and has a lever or an
/// encoder. All other joints keep their initial position.
std::vector<std::size_t> EstimatedJoints(const DiagnosisInput& input, const Measurements& measured);

}  // namespace tera
