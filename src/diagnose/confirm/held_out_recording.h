#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// One channel of a held-out recording, predicted without and with what was found in another one.
struct HeldOutChannel {
  std::string channel, unit;
  double rmse_before = 0, rmse_after = 0;
  double p = 1;  ///< of so steady a gain, by chance
};

/// The validation of a diagnosis on a recording that it has not seen.
struct HeldOutRecording {
  std::string recording;  ///< its name in reports
  std::vector<HeldOutChannel> channels;
  std::vector<std::string> missing;  ///< blocks with findings whose channels it lacks
};

/// Validates findings on one block of a held-out recording: replays it without any term and with
/// all that the diagnosis found in the block of the same name.
///
/// Model   nuisances (likelihood.h) are fitted to the held-out recording in both cases, so that
///         their gain counts for neither; the noise is that beside the flexible regressor. RMSE
///         over all samples.
std::vector<HeldOutChannel> ValidateOnBlock(const ReplayBlock& further, const Structure& found,
                                            const Stream& stream);

}  // namespace tera
