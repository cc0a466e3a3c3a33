#pragma once

#include <optional>
#include <vector>

#include "core/random.h"
#include "diagnose/proposal/proposal.h"

namespace tera {

/// Tabulates a formula of one variable as a curve over this variable. If all terms are functions of
/// the variable, the curve is their sum. If all terms are such functions times the rate, the curve
/// is a share of the rate. Empty for any other formula. `predicted` is the channel's prediction,
/// named "rate" in a formula.
///
/// Model   the curve has a value at the centre of each bin of the variable (regime_axis.h). Its
///         band is 1.645 standard deviations wide; the errors of the terms count as independent.
std::optional<ProposedCurve> TabulatedFormula(const Channel& channel,
                                              const std::vector<double>& predicted,
                                              const std::vector<ProposedTerm>& terms);

/// A curve as a learned effect of `variable`.
///
/// Model   a share is limited to the range from -1 (the axis stops) to 9. The effect is 0 across
///         gaps of `seen` samples wider than a quarter of the variable's range.
LearnedEffect TabulatedCurve(const ProposedCurve& curve, const LearnedVariable& variable,
                             const std::vector<double>& seen);

/// Adds to a proposal the effect that a simulation can run, or the reason why there is none.
///
/// Model   there are up to four candidates, in this order. The first is the formula, if it has one
///         variable. The next two are the curve over the variable that locates the error, and the
///         curve over the proposed variable. Both need a variable that a simulation knows
///         (ReplayBlock::learnable). The last is the best curve over any variable that a simulation
///         knows. A later candidate replaces an earlier one if its RMSE on SELECT is below nine
///         tenths of the earlier RMSE. Curves are fitted to measured minus predicted values. They
///         therefore include errors that a fit of the whole block assigns to nuisance parameters,
///         such as 2 % of the rate, because a simulation has no nuisance parameters. The comparison
///         uses the replay's response to the effect, including the limits that keep it from moving
///         an axis at rest (learned_rate.h). There is no effect if it reduces the RMSE on FINAL by
///         less than a twentieth.
void Learn(const ReplayBlock& block, const BlockDiagnosis& diagnosis, const Stream& stream,
           Proposal* proposal);

}  // namespace tera
