#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosed_block.h"

namespace tera {

/// The proposal for a channel's residual, or nullptr.
const Proposal* ProposalFor(const DiagnosedBlock& diagnosed, std::size_t channel);

/// "|arm lever| · boom rate", "cos(angle)".
std::string TermText(const ReplayBlock& block, const std::vector<Factor>& factors);

/// SI unit of a term's coefficient: that of the channel over those of the factors.
std::string CoefficientUnit(const ReplayBlock& block, std::size_t channel,
                            const std::vector<Factor>& factors);

/// "-0.25 · rate · |arm lever| + 0.01 rad/s · cos(angle)", to be added to the simulated value; SI.
std::string FormulaText(const ReplayBlock& block, const Proposal& proposal);

/// "Boom rate: a formula for what is left, a proposal and no name: add −0.25 ± 0.01 · rate · |arm
/// lever|; chosen in 98 % of random halves; held-out RMSE 1.1 → 0.3 deg/s." Then LearnedText.
std::string SentenceOf(const ReplayBlock& block, const Proposal& proposal);

/// Whether the next simulation has the proposal, and its held-out error: "As a function of arm
/// lever it is in effects.yaml as learned: held-out RMSE 1.1 → 0.3 deg/s in the replay."
std::string LearnedText(const ReplayBlock& block, const Proposal& proposal);

}  // namespace tera
