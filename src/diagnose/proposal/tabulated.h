#pragma once

#include <optional>
#include <vector>

#include "diagnose/proposal/proposal.h"

namespace tera {

/// A formula of one variable as a curve over it: each term a function of it, added, or each term
/// the rate times such a function, as a share. None where it is neither.
///
/// Model   at the centres of the variable's bins (regime_axis.h). Band: 1.645 standard deviations,
///         those of the terms taken as independent.
/// `predicted` is the channel's prediction, which "rate" in a formula stands for.
std::optional<ProposedCurve> TabulatedFormula(const Channel& channel,
                                              const std::vector<double>& predicted,
                                              const std::vector<ProposedTerm>& terms);

/// A curve as a learned effect of `variable`.
///
/// Model   shares are from -1, a rate that stops, to 9. Where no `seen` sample of the variable lies
///         in more than a quarter of its range at a stretch, the effect is 0.
LearnedEffect TabulatedCurve(const ProposedCurve& curve, const LearnedVariable& variable,
                             const std::vector<double>& seen);

}  // namespace tera
