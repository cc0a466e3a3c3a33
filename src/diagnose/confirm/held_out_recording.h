#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// Errors of one channel of a held-out recording, without terms and with the findings of another
/// recording.
struct HeldOutChannel {
  std::string channel, unit;
  double rmse_before = 0, rmse_after = 0;
  double p = 1;  ///< p-value of the steadiness of the gain
};

struct HeldOutRecording {
  std::string recording;  ///< its name in reports
  std::vector<HeldOutChannel> channels;
  std::vector<std::string> missing;  ///< blocks with findings whose channels it lacks
};

/// Validates findings on one block of a held-out recording. The block is replayed without terms,
/// and with all findings of the block of the same name.
///
/// Model   nuisance parameters (likelihood.h) are fitted to the held-out recording in both cases,
///         so that their gain cancels. The noise is estimated with the flexible regressor. RMSE is
///         over all samples.
std::vector<HeldOutChannel> ValidateOnBlock(const ReplayBlock& further, const Structure& found,
                                            const Stream& stream);

}  // namespace tera
