#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// One channel of a further recording, without and with what was found in another one.
struct HeldOutChannel {
  std::string channel, unit;
  double rmse_before = 0, rmse_after = 0;
  double p = 1;  ///< of a gain so steady by chance
};

/// What a diagnosis is worth on a recording that it has not seen.
struct HeldOutRecording {
  std::string recording;  ///< how the reports name it
  std::vector<HeldOutChannel> channels;
  std::vector<std::string> missing;  ///< blocks with findings that it has no channels for
};

/// Replays one block of the further recording without anything and with all that the diagnosis
/// found in the block of the same name.
///
/// Model   nuisances (likelihood.h) are fitted to the further recording on both sides, so that what
///         they could do counts for neither; the noise is what the flexible regressor leaves of it.
///         RMSE over all of its samples.
std::vector<HeldOutChannel> ValidateOnBlock(const ReplayBlock& further, const Structure& found,
                                            const Stream& stream);

}  // namespace tera
