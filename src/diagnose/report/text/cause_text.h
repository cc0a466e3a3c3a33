#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "diagnose/diagnosis.h"

// Describes a named cause in plain words for users of a machine.

namespace tera {

/// A candidate's target: "the boom", "the encoder of the boom", "the receiver gnss left", "the
/// machine".
std::string TargetText(const Candidate& candidate);

/// Fills the placeholders of MechanismWords::meaning from a finding.
std::string FilledIn(std::string_view meaning, const Finding& finding);

/// "The boom does not move while its lever is within 12 % of neutral." Empty for a difference of
/// the scene; SentenceOf states it.
std::string MeaningText(const Cause& cause);

/// "Boom: dead band or valve curve": heading of a finding with its rivals.
std::string HeadingOf(const Candidate& found, const std::vector<const Candidate*>& alike);

/// "Fairly sure.", "Sure that something is wrong here, not which of 2 causes it is."
std::string HowSureText(const Cause& cause);

}  // namespace tera
