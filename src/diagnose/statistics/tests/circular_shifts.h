#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"

namespace tera {

/// Circular shifts of a series of `size` samples against another one: by how many samples each of
/// them turns it, from `least` to size - `least`; at most `most`, fewer, or none, where the series
/// is short. Shifts keep the autocorrelation of both series and destroy the dependence between
/// them: the reference distribution of every dependence test here.
///
/// Model   shift k turns the whole series by least + (k + u) * stride samples, the stride at least
///         `least`, so that shifts are nearly independent of each other and of no shift at all.
/// Omits   the seam at which end meets beginning. One of the two series should be stationary.
/// Source  Harris 2020, "A shift test for independence in generic time series".
std::vector<std::size_t> CircularShifts(std::size_t size, std::size_t least, std::size_t most,
                                        const Stream& stream);

/// The place of an observed statistic among those under shifts.
///
/// Model   p = (1 + #{shifted >= observed}) / (1 + shifts). p_tail, for ranking what lies beyond
///         all shifts: p where ten shifts or more exceed, else an exponential tail through the
///         upper fifth of the shifts (statistics are energies), never above p. Equals p below 50
///         shifts.
/// Source  Phipson and Smyth 2010, "Permutation p-values should never be zero"; Knijnenburg et al.
///         2009, "Fewer permutations, more accurate P-values".
struct ShiftComparison {
  double p = 1, p_tail = 1;
};
ShiftComparison CompareWithShifts(double observed, std::vector<double> shifted);

}  // namespace tera
