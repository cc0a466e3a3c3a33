#pragma once

#include <vector>

#include "diagnose/diagnosis_input.h"

namespace tera {

/// The hinge axes that count against both their levers and the turning that inertial units measure
/// about them. Against one alone, the unit or the lever may be reversed.
///
/// Model   a hinge turns by the turning of the unit behind it about its axis, minus that of the
///         unit before it. This needs no angle. Rates are differences of positions over a fifth of
///         a second. They are correlated with units and levers at the most similar delay, up to
///         half a second. An axis counts backwards about zero or about the middle of the joint's
///         travel, whichever brings the first reading nearer to the scenario's position.
///         p is that of opposing the units, or the lever if that is larger, as steadily by chance
///         (AntiCorrelationPValue), over as many tries as there are delays.
/// Omits   joints that slide, running gear, hinges without units on both sides.
std::vector<ReversedAxis> ReversedAxesOf(const DiagnosisInput& input, const Measurements& measured);

/// Lets these axes count forwards.
void CountForwards(const std::vector<ReversedAxis>& reversed, Measurements* measured);

}  // namespace tera
