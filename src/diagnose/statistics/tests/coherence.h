#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"
#include "diagnose/statistics/series/series.h"
#include "diagnose/statistics/tests/circular_shifts.h"

namespace tera {

struct CoherenceOptions {
  std::size_t window = 256;  ///< samples, a power of two
  std::size_t shifts = 200;
  double most_missing = 0.2;  ///< share of gaps above which a window is ignored
};

/// Linear dependence of two series by frequency.
///
/// Model   magnitude-squared coherence |S_xy|^2 / (S_xx S_yy), spectra averaged over Hann
///         windows that overlap by half (Welch), each window's mean removed and its gaps
///         set to 0. Statistic: the largest coherence over all frequencies but 0, against
///         the same with one series' windows turned circularly (shifts by whole
///         half-windows).
/// Omits   correction of the bias 1 / windows.
/// Source  Welch 1967; Carter, Knapp and Nuttall 1973, "Estimation of the magnitude-squared
///         coherence function via overlapped FFT processing".
struct Coherence {
  std::vector<double> frequency_hz, coherence;
  double peak_hz = 0;
  std::size_t windows = 0;
  ShiftComparison comparison;
};

/// `a` and `b` of equal length. Fewer than 8 windows: no p below 1.
Coherence TestCoherence(const Series& a, const Series& b, const CoherenceOptions& options,
                        const Stream& stream);

}  // namespace tera
