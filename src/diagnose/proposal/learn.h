#pragma once

#include <optional>
#include <vector>

#include "core/random.h"
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

/// Adds to a proposal the effect that a simulation can run, or the reason why there is none.
///
/// Model   candidates in this order. First the formula, if it has one variable. Then the curves
///         over the variable of the error's location and over the proposed one, if a simulation
///         knows them (ReplayBlock::learnable). Last the best curve over the variables that a
///         simulation knows. A later one replaces an earlier one if its RMSE on SELECT is below
///         nine tenths. Curves are fitted to measured minus predicted. They include what a fit of
///         the whole block assigns to nuisances, such as 2 % of the rate, for a simulation has no
///         nuisances. The comparison uses the replay's response to the effect, including the limits
///         that keep it from moving an axis at rest (learned_rate.h). None where FINAL's RMSE falls
///         by less than a twentieth.
void Learn(const ReplayBlock& block, const BlockDiagnosis& diagnosis, const Stream& stream,
           Proposal* proposal);

}  // namespace tera
