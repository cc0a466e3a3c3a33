#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/block/evaluation_context.h"
#include "diagnose/search/structure/search_result.h"

namespace tera {

/// An interval in which a rate keeps the value predicted for its beginning.
struct Hold {
  Segment samples;
  double gain = 0;  ///< in log-likelihood, of the held over the predicted rate
};

/// Noise of a rate.
struct HoldNoise {
  double scale = 0;
  double inflation = 1;  ///< variance of a mean, relative to that of independent errors
};

/// Intervals in which a measured rate holds the predicted value while the prediction moves on. A
/// drive that no message reaches keeps its last command.
///
/// Model   disjoint intervals of 0.08 to 5 s with the largest gains. Errors are Student-t with 5
///         degrees of freedom and the noise's scale. Correlated errors count less, by `inflation`.
///         A hold must gain more than the logarithm of the number of intervals tried, plus 5.
/// Omits   how the drive follows its command: the rate jumps at once at the end of a hold.
///
/// `residual` is measured minus `predicted`. With `early`, the intervals hold the value predicted
/// for their end. No physical effect does so, hence these count how often model errors look like
/// holds.
std::vector<Hold> HoldsOf(const Series& residual, const std::vector<double>& predicted,
                          const HoldNoise& noise, bool early = false);

/// The residual where the prediction is held.
Series WithHolds(Series residual, const std::vector<double>& predicted,
                 const std::vector<Hold>& holds);

/// Commands lost at random, which no replay can predict.
struct LostCommands {
  std::vector<Hold> holds;  ///< by time
  double p = 1;             ///< p-value of such a gain
  double period_s = 0;      ///< median length of the holds
  double probability = 0;   ///< share of lost commands, in the time in which a loss is visible
  double rmse_before = 0, rmse_after = 0;  ///< over all samples, without and with the holds
};

/// Commands that a drive lost and that no other finding explains. Returns nullopt if the rate shows
/// no loss.
///
/// Model   at least three holds of the residual (HoldsOf). They must gain twice as much as `early`
///         holds, and reduce the mean square by at least the square of `tolerated`.
///         Play and dead bands also hold, but repeat with the lever's motion. Hence at most nine of
///         ten holds may begin at a reversal. The cross-fitted flexible regressor must explain none
///         of the error in the holds, or leave at least half of their gain. Each single mechanism
///         that gains on TRAIN and SELECT, added as fitted alone, must leave at least half of it.
/// Omits   losses while the lever rests.
std::optional<LostCommands> LostCommandsOf(const EvaluationContext& context,
                                           const SearchResult& search, double noise_rms,
                                           double tolerated);

}  // namespace tera
