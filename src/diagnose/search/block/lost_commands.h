#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/block/evaluation_context.h"
#include "diagnose/search/structure/search_result.h"

namespace tera {

/// An interval in which a rate keeps the value that was predicted for its beginning.
struct Hold {
  Segment samples;
  double gain = 0;  ///< gain in log-likelihood of the held rate over the predicted rate
};

struct HoldNoise {
  double scale = 0;
  double inflation = 1;  ///< variance of a mean / variance for independent errors
};

/// Intervals in which a measured rate stays constant while the prediction changes. A drive that
/// receives no message keeps its last command.
///
/// Model   disjoint intervals of 0.08 to 5 s with the largest gains. Errors are Student-t with 5
///         degrees of freedom and the scale of the noise. Correlated errors weigh less, by
///         `inflation`. A hold must gain more than 5 plus the logarithm of the number of tried
///         intervals.
/// Omits   the drive's response at the end of a hold: the rate jumps at once.
///
/// `residual` is measured minus `predicted`. With `early`, intervals hold the value predicted for
/// their end. No physical effect does this. Early holds therefore count how often model errors look
/// like holds.
std::vector<Hold> HoldsOf(const Series& residual, const std::vector<double>& predicted,
                          const HoldNoise& noise, bool early = false);

/// The residual with the prediction held in `holds`.
Series WithHolds(Series residual, const std::vector<double>& predicted,
                 const std::vector<Hold>& holds);

/// Commands lost at random, which no replay can predict.
struct LostCommands {
  std::vector<Hold> holds;                 ///< ordered by time
  double p = 1;                            ///< p-value of the gain of the holds
  double period_s = 0;                     ///< median length of a hold
  double probability = 0;                  ///< share of commands lost while a loss would be visible
  double rmse_before = 0, rmse_after = 0;  ///< RMSE over all samples, without and with holds
};

/// Lost commands that no other finding explains. Empty if the rate shows no loss.
///
/// Model   There are at least three holds of the residual (HoldsOf). They gain twice as much as
///         `early` holds, and reduce the mean square by at least `tolerated` squared.
///
///         Play and dead bands also hold the rate, but repeat with the motion of the lever. Three
///         conditions exclude them. At most nine of ten holds begin at a reversal. The cross-fitted
///         flexible regressor explains none of the error in the holds, or leaves at least half of
///         their gain. Each single mechanism that gains on TRAIN and SELECT leaves at least half of
///         their gain when added as fitted alone.
/// Omits   losses while the lever rests.
std::optional<LostCommands> LostCommandsOf(const EvaluationContext& context,
                                           const SearchResult& search, double noise_rms,
                                           double tolerated);

}  // namespace tera
