#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// "dead band 0.18 ± 0.02, asymmetry 0.1 ± 0.05": the mechanism and those of its numbers that were
/// fitted and are worth telling.
std::string NameAndNumbers(const Finding& finding);

/// The same, of what it acts on where the channel does not say so: "flow sharing of the main 0.8".
std::string MechanismText(const DiagnosedBlock& diagnosed, const Finding& finding);

/// "latency", and "latency of the poses" where that acts on something else than what was found.
std::string RivalText(const Suspect& rival, const Suspect& found);

/// What a finding was not told apart from.
std::vector<std::string> AlikeTexts(const Finding& finding);

/// "chosen with p 0.0002, confirmed with p 0.001; rivals rejected: valve curve (p 0.003)".
std::string EvidenceClause(const Finding& finding);

/// Whether a free parameter is worth telling: of few all, of many those that are clearly not as
/// they would be without the finding.
bool IsTold(const Finding& finding, const FreeParameter& free);

/// Whether something was chosen for a channel that manoeuvres kept back did not confirm.
bool IsUnconfirmed(const DiagnosedBlock& diagnosed, std::size_t channel);

}  // namespace tera
