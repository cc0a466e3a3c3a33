#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/diagnosis_input.h"
#include "diagnose/measurements.h"

namespace tera {

/// The joints of the model whose motion the sensors' errors are asked beside: on the way from the
/// base to an inertial unit or an antenna that measured, not fixed, and with a lever or an encoder.
/// All others stay as the model has them at first.
std::vector<std::size_t> EstimatedJoints(const DiagnosisInput& input, const Measurements& measured);

}  // namespace tera
