#pragma once

#include <vector>

#include "diagnose/diagnosis_input.h"

namespace tera {

/// The axes of hinges that count against both what inertial units turn about them and their levers.
/// Either alone may be what is reversed.
///
/// Model   a hinge turns by what the unit behind it turns about its axis more than the unit before
///         it, which needs no angle. Rates by differences of positions over a fifth of a second,
///         correlated with units and levers at the delay, up to half a second, at which they look
///         most alike. It counts backwards about zero or about the middle of the joint's travel,
///         whichever brings the first reading nearer to where the scenario has the joint.
///         Its p is that of going against the units, or against the lever if that is the larger
///         one, as steadily by chance (OppositionP), over as many tries as there are delays.
/// Omits   joints that slide, running gear, hinges without units on both sides.
std::vector<ReversedAxis> ReversedAxesOf(const DiagnosisInput& input, const Measurements& measured);

/// Lets these axes count forwards.
void CountForwards(const std::vector<ReversedAxis>& reversed, Measurements* measured);

}  // namespace tera
