#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "diagnose/diagnosis.h"

// A named cause in the words of a machine's user.

namespace tera {

/// "the boom", "the encoder of the boom", "the receiver gnss left", "the machine": a candidate's
/// target.
std::string TargetText(const Candidate& candidate);

/// Fills the placeholders of MechanismWords::meaning from a finding.
std::string FilledIn(std::string_view meaning, const Finding& finding);

/// "The boom does not move while its lever is within 12 % of neutral." Empty for a difference of
/// the scene, which SentenceOf states.
std::string MeaningText(const Cause& cause);

/// "Boom: dead band or valve curve", a heading of the finding and its rival hypotheses.
std::string HeadingOf(const Candidate& found, const std::vector<const Candidate*>& alike);

/// "Fairly sure.", "Sure that something is wrong here, not which of 2 causes it is."
std::string HowSureText(const Cause& cause);

}  // namespace tera
