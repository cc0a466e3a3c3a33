#pragma once

#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// The text of diagnosis.json.
///
/// Model   format: 2. Format 1 lacked this key, and had other names for some keys
///         (docs/reference/diagnose.md). verdict: a list of names. findings: by descending
///         importance; named ones come before those with mechanism "unexplained". The latter have
///         no slot, target or parameters, and their held-out error is the residual. untestable:
///         mechanisms that are undetectable at any size.
///         Values are in SI units and radians with six digits; null is an unknown value. Times are
///         in seconds from the block's first sample. regime.shape is parity and form; "odd
///         threshold outside" means that the error lies beyond [low, high]. next_manoeuvre has the
///         hypotheses that the file of levers discriminates ("nothing": no effect), with the power.
///         whole_simulation and next_manoeuvre may be null.
std::string DiagnosisJson(const Diagnosis& diagnosis);

}  // namespace tera
