#pragma once

#include <cstddef>

#include "diagnose/statistics/series/series.h"

namespace tera {

struct VarianceRatioOptions {
  double clip = 4;        ///< in robust scales of the reference; larger values count as this
  std::size_t block = 0;  ///< samples; 0: a thirtieth of the shorter series, 20 at least
};

struct VarianceRatioResult {
  double ratio = 1;  ///< of mean energies, judged to reference
  double p = 1;      ///< of a ratio this large or larger where the two are alike
};

/// Tests whether a series has more energy than the noise that was measured at rest.
///
/// Model   energies min(|x|, clip)^2 about zero, means over blocks of each series; log of
///         the ratio over its standard error from the scatter of the block means (which
///         autocorrelation within a block enters), Student-t with Welch's degrees of
///         freedom.
/// Omits   correlation beyond a block.
/// Source  Welch 1947; batch means as in Law and Kelton, "Simulation modeling and analysis".
///
/// Both need two blocks with valid samples; one may be the other's standstill.
VarianceRatioResult VarianceRatio(const Series& judged, const Series& reference,
                                  const VarianceRatioOptions& options = {});

}  // namespace tera
