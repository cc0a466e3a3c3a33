#pragma once

#include <cstdint>
#include <vector>

#include "core/types/labels.h"

namespace tera {

/// One echo of a pulse.
struct Echo {
  double range_m = 0;
  double power = 0;  ///< as in RangeEquation
  SemanticClass label = SemanticClass::kSky;
  std::uint16_t instance = 0;
  bool is_air = false;  ///< scattered by the air
};

/// Peaks of the received signal of one pulse, in order of range.
///
/// Model   each echo adds a Gaussian pulse at its range with the full width `pulse_m` at half
///         power, c / 2 of the pulse's duration. The local maxima of the sum are the peaks, with
///         their range and power. Surfaces within a pulse share a peak between them (mixed pixel):
///         two equal echoes have separate peaks if they are at least 2 sigma apart, which is 0.85
///         `pulse_m`. A peak belongs to the echo with the largest contribution.
/// Omits   the receiver's own width, ringing, saturation.
/// Source  Wagner et al. 2006, as RangeEquation; the separation of equal Gaussians: Behboodian
///         1970, "On the modes of a mixture of two normal distributions", Technometrics 12.
void FindPeaks(std::vector<Echo>* echoes, double pulse_m, std::vector<Echo>* peaks);

}  // namespace tera
