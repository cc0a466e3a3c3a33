#pragma once

#include <string>
#include <string_view>

#include "diagnose/report/text/cause.h"

namespace tera {

/// "the boom", "the encoder of the boom", "the receiver gnss left", "the machine": a candidate's
/// target.
std::string TargetText(const Candidate& candidate);

/// Fills the placeholders of MechanismWords::meaning from a finding. Adds parameters without a
/// placeholder, and the mechanism's values in the scenario.
std::string FilledIn(std::string_view meaning, const Finding& finding);

/// "The boom does not move while its lever is within 12 % of neutral."
std::string MeaningText(const Cause& cause);

/// "With this dead band the error on driving it had not seen falls from 1.6 to 0.2 deg/s."
std::string FallText(const Cause& cause);

/// "Or it is a valve curve: this recording does not tell." Empty without an equal rival.
std::string ClassText(const Cause& cause);

/// "Boom: dead band or valve curve", a heading.
std::string HeadingOf(const Cause& cause);

}  // namespace tera
