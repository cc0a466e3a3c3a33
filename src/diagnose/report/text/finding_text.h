#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// "dead band 0.18 ± 0.02, asymmetry 0.1 ± 0.05": the mechanism with its fitted and reported
/// parameters.
std::string NameAndNumbers(const Finding& finding);

/// NameAndNumbers with the target, where the channel does not name it: "flow sharing of the main
/// 0.8".
std::string MechanismText(const DiagnosedBlock& diagnosed, const Finding& finding);

/// "latency", and "latency of the poses" where the rival acts on another target than the finding.
std::string RivalText(const Candidate& rival, const Candidate& found);

/// The rivals of a finding, as texts.
std::vector<std::string> AlikeTexts(const Finding& finding);

/// "chosen with p 0.0002, confirmed with p 0.001; rivals rejected: valve curve (p 0.003)".
std::string EvidenceClause(const Finding& finding);

/// Whether a free parameter is reported. With few parameters all are; with many, only those that
/// differ significantly from their value without the finding.
bool IsReported(const Finding& finding, const FreeParameter& free);

/// Whether a mechanism was selected for a channel but not confirmed on FINAL.
bool IsUnconfirmed(const DiagnosedBlock& diagnosed, std::size_t channel);

}  // namespace tera
