#pragma once

#include <cstddef>
#include <optional>

#include "diagnose/proposal/proposal.h"

namespace tera {

/// Proposes a correction for a channel's residual: a formula or a curve. The curve is taken if its
/// RMSE on SELECT is below nine tenths of that of the formula. The proposal also holds the effect
/// that a simulation can run, or the reason why there is none (learn.h). Empty if neither formula
/// nor curve holds on manoeuvres outside its fit.
std::optional<Proposal> Propose(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                                std::size_t channel, const Stream& stream);

}  // namespace tera
