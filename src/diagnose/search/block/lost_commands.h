#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/block/evaluation_context.h"
#include "diagnose/search/structure/search_result.h"

namespace tera {

/// A time over which a rate stayed what it was predicted to be when it began.
struct Hold {
  Segment samples;
  double gain = 0;  ///< in log-likelihood, of the rate held over the rate predicted
};

/// The noise of a rate.
struct HoldNoise {
  double scale = 0;
  double inflation = 1;  ///< variance of a mean over that of independent errors
};

/// The times over which a measured rate holds what was predicted while the prediction went on: a
/// drive that no message reaches keeps its last command.
///
/// Model   of all stretches of 0.08 to 5 s those that gain most, none upon another: errors are
///         Student's t of 5 degrees of freedom with the noise's scale. As they follow each other,
///         so many count as one as make a mean worse. A hold must gain more than the logarithm of
///         the number of stretches that were tried, and 5.
/// Omits   how the drive follows its command: what a rate does at once after a hold.
///
/// `residual` is measured less `predicted`. With `early`, stretches that hold what is predicted
/// at their end: nothing physical does so, and form errors do it as often.
std::vector<Hold> HoldsOf(const Series& residual, const std::vector<double>& predicted,
                          const HoldNoise& noise, bool early = false);

/// The residual where the prediction is held.
Series WithHolds(Series residual, const std::vector<double>& predicted,
                 const std::vector<Hold>& holds);

/// Commands that did not reach a drive: which ones nobody knows beforehand, so that no replay
/// predicts them.
struct LostCommands {
  std::vector<Hold> holds;  ///< in the order of their times
  double p = 1;             ///< of such a gain by chance
  double period_s = 0;      ///< median length of the holds
  double probability = 0;   ///< their share of the time in which losses would be seen
  double rmse_before = 0, rmse_after = 0;  ///< over all samples, without and with the holds
};

/// The commands that a drive with a lever lost, beside all that was found; none where its rate does
/// not show them.
///
/// Model   holds (HoldsOf) of what is left, three at least. They gain twice what holds of the
///         end do, and take as much error as is `tolerated`. Play and dead bands hold as well, but
///         come back with the lever's motion: no more than nine of ten holds begin where it goes
///         back, and the flexible regressor, cross-fitted, explains none of the error in the
///         holds, or leaves holds that gain half as much; and so does each mechanism of the library
///         beside what was found, as it was fitted alone.
/// Omits   losses while the lever rests.
std::optional<LostCommands> LostCommandsOf(const EvaluationContext& context,
                                           const SearchResult& search, double noise_rms,
                                           double tolerated);

}  // namespace tera
