#pragma once

#include <vector>

#include "diagnose/diagnosis_input.h"

namespace tera {

/// Encoder axes of hinges that oppose both their lever and the turn rate from inertial units.
/// Opposition to only one of them may come from a reversed unit or lever.
///
/// Model   the turn rate of a hinge is the rate of the unit behind it about its axis, minus the
///         rate of the unit before it. No angle is needed. Encoder rates are differences of
///         positions over 0.2 s. They are correlated with units and lever at the delay within 0.5 s
///         that gives the largest magnitude. The corrected angle is mirrored about zero or about
///         the middle of the joint's travel, whichever brings the first reading nearer to the
///         scenario's initial position. p is the larger of the p-values against units and against
///         the lever (OppositionP), corrected for the number of delays.
/// Omits   sliding joints, running gear, hinges without units on both sides.
std::vector<ReversedAxis> ReversedAxesOf(const DiagnosisInput& input, const Measurements& measured);

/// Mirrors the readings of these axes.
void CountForwards(const std::vector<ReversedAxis>& reversed, Measurements* measured);

}  // namespace tera
