#pragma once

#include <optional>
#include <vector>

#include "diagnose/proposal/proposal.h"

namespace tera {

/// Tabulates a formula of one variable as a curve over it. All terms must be functions of the
/// variable, which add up, or all the rate times such a function, which form a share. None
/// otherwise. `predicted` is the channel's prediction, named "rate" in a formula.
///
/// Model   at the centres of the variable's bins (regime_axis.h). Band: 1.645 standard deviations,
///         with the terms taken as independent.
std::optional<ProposedCurve> TabulatedFormula(const Channel& channel,
                                              const std::vector<double>& predicted,
                                              const std::vector<ProposedTerm>& terms);

/// A curve as a learned effect of `variable`.
///
/// Model   shares are limited to -1, a rate that stops, to 9. The effect is 0 across gaps of `seen`
///         samples wider than a quarter of the variable's range.
LearnedEffect TabulatedCurve(const ProposedCurve& curve, const LearnedVariable& variable,
                             const std::vector<double>& seen);

}  // namespace tera
