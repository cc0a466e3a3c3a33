#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/diagnosis_input.h"
#include "diagnose/measurements.h"

namespace tera {

/// The joints of the model whose motion is estimated with the sensors' errors. They lie between the
/// base and an inertial unit or antenna with samples, are not fixed, and have a lever or an
/// encoder. All others keep the model's initial position.
std::vector<std::size_t> EstimatedJoints(const DiagnosisInput& input, const Measurements& measured);

}  // namespace tera
