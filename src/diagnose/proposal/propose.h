#pragma once

#include <cstddef>
#include <optional>

#include "diagnose/proposal/proposal.h"

namespace tera {

/// The proposal for a channel's residual, if one generalises: a formula, unless a curve's RMSE on
/// SELECT is below nine tenths of the formula's. Includes the effect that a simulation can run, or
/// the reason why there is none (learn.h).
std::optional<Proposal> Propose(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                                std::size_t channel, const Stream& stream);

}  // namespace tera
