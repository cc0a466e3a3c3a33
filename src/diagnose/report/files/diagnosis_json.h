#pragma once

#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// The text of diagnosis.json.
///
/// Model   format: 2; format 1 had no such key, and other names for some of the others
///         (docs/reference/diagnose.md). verdict: a list of names; findings: the weightiest first,
///         named ones before those with mechanism "unexplained", which have no slot, target or
///         parameters and whose held-out error is what is left; untestable: mechanisms that would
///         not have been seen at any size. SI units and radians; times in seconds from the block's
///         first sample; six digits; null where something is not known. regime.shape is parity and
///         form, "odd threshold outside" where the error lives beyond [low, high].
///         whole_simulation, next_manoeuvre: null, or what the file of levers beside it
///         discriminates ("nothing": from no effect), with its power.
std::string DiagnosisJson(const Diagnosis& diagnosis);

}  // namespace tera
