#pragma once

#include <cstddef>
#include <optional>

#include "diagnose/proposal/proposal.h"

namespace tera {

/// The proposal for what is left of a channel, if one holds: a formula, unless a curve leaves less
/// than nine tenths of the formula's RMSE on SELECT; with the effect that a simulation can run, or
/// why there is none (learn.h).
std::optional<Proposal> Propose(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                                std::size_t channel, const Stream& stream);

}  // namespace tera
