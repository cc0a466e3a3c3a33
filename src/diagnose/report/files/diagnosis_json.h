#pragma once

#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// The text of diagnosis.json.
///
/// Model   format: 2. Format 1 lacked this key, and had other names for some keys
///         (docs/reference/diagnose.md). verdict: a list of names. findings: by descending weight,
///         named ones before those with mechanism "unexplained". The latter have no slot, target or
///         parameters, and their held-out error is the residual. untestable: mechanisms that are
///         undetectable at any size. SI units and radians; times in seconds from the block's first
///         sample; six digits; null for unknown values. regime.shape is parity and form, "odd
///         threshold outside" where the error lies beyond [low, high]. whole_simulation,
///         next_manoeuvre: null, or the hypotheses that the accompanying file of levers
///         discriminates ("nothing": from no effect), with its power.
std::string DiagnosisJson(const Diagnosis& diagnosis);

}  // namespace tera
