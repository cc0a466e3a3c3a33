#pragma once

#include <optional>
#include <vector>

#include "core/random.h"
#include "core/types/learned_effect.h"
#include "diagnose/learned/curve_fit.h"
#include "diagnose/search/block/block_diagnosis.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// An unexplained error of a channel as an effect that a simulation can run. It describes the error
/// without naming its cause.
struct Learned {
  std::size_t channel = 0;
  LearnedEffect effect;
  double rmse_before = 0, rmse_after = 0;  ///< in the replay, on FINAL, which no fit used
};

/// A curve as a learned effect of `variable`.
///
/// Model   shares are limited to -1, a rate that stops, to 9. The effect is 0 across gaps of `seen`
///         samples wider than a quarter of the variable's range.
LearnedEffect TabulatedCurve(const FittedCurve& curve, const LearnedVariable& variable,
                             std::vector<double> seen);

/// Learns a channel's unexplained error, if a simulation can have it.
///
/// Model   the curve over the variable of the error's location, if a simulation knows it
///         (ReplayBlock::learnable). The best curve over the variables that a simulation knows
///         replaces it if its RMSE on SELECT is below nine tenths. Curves are fitted to measured
///         minus predicted. They include what a fit of the whole block assigns to nuisances, such
///         as 2 % of the rate, for a simulation has no nuisances. The comparison uses the replay's
///         response to the effect, including the limits that keep it from moving an axis at rest
///         (learned_rate.h). None where FINAL's RMSE falls by less than a twentieth.
std::optional<Learned> Learn(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                             std::size_t channel, const Stream& stream);

}  // namespace tera
