#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// "0.18 ± 0.02, asymmetry 0.1 ± 0.05": the fitted and reported parameters.
std::string NumbersText(const Finding& finding);

/// "dead band 0.18 ± 0.02, asymmetry 0.1 ± 0.05": the mechanism with its fitted and reported
/// parameters.
std::string NameAndNumbers(const Finding& finding);

/// NameAndNumbers, with the target if the channel does not name it: "flow sharing of the main 0.8".
std::string MechanismText(const DiagnosedBlock& diagnosed, const Finding& finding);

/// "latency". If the rival acts on another target than the finding: "latency of the poses".
std::string RivalText(const Candidate& rival, const Candidate& found);

/// RivalText of each rival of a finding.
std::vector<std::string> AlikeTexts(const Finding& finding);

/// "chosen with p 0.0002, confirmed with p 0.001; rivals rejected: valve curve (p 0.003)".
std::string EvidenceClause(const Finding& finding);

/// True if a free parameter is reported. A mechanism with few parameters reports all. Otherwise
/// only parameters are reported that differ significantly from their value without the finding.
bool IsReported(const Finding& finding, const FreeParameter& free);

/// True if a mechanism was selected for a channel but not confirmed on FINAL.
bool IsUnconfirmed(const DiagnosedBlock& diagnosed, std::size_t channel);

/// "Boom rate, 41–63 s and 8 more intervals; the error depends on |lever| < 0.2, odd: dead band
/// 0.18 ± 0.02 (chosen with p 0.0002, confirmed with p 0.001; rivals rejected: valve curve (p
/// 0.003)). Held-out RMSE 3.1 → 0.6 deg/s, 94 % of the excess variance removed. Left: 0.6 deg/s at
/// a noise of 0.5 deg/s."
///
/// Times count from the recording's start. The named interval is the one with the largest error.
/// "±" follows parameters that the data determine. Parameters that were not fitted are left out.
std::string SentenceOf(const DiagnosedBlock& diagnosed, const Finding& finding);

/// Sentence of an unexplained error: its location, and the variable on which it depends.
std::string SentenceOf(const DiagnosedBlock& diagnosed, const Unexplained& unexplained);

/// "Boom rate: effects.yaml has the unexplained error as learned, a function of angle: held-out
/// RMSE 1.1 → 0.3 deg/s in the replay."
std::string SentenceOf(const ReplayBlock& block, const Learned& learned);

/// The sentence of a mechanism that was selected but not confirmed on FINAL.
std::string SentenceOfUnconfirmed(const DiagnosedBlock& diagnosed, const Finding& finding);

/// Sentence of a mechanism within tolerance, or of one with a rival within tolerance.
std::string SentenceOfExpected(const DiagnosedBlock& diagnosed, const Finding& finding);

/// Sentence of a proxy: the mechanism nearest to an unexplained error, which is not its cause.
std::string SentenceOfProxy(const DiagnosedBlock& diagnosed, const Finding& finding);

/// Sentence of a block with too few manoeuvres, or without time left.
std::string SentenceOfUntestable(const DiagnosedBlock& diagnosed);

/// Sentence of an axis that moves without its lever.
std::string SentenceOf(const MissingInput& missing);

/// "|lever| < 0.2, odd", in readable units.
std::string RegimeText(const Regime& regime, const DiagnosedBlock& diagnosed, std::size_t channel);

}  // namespace tera
