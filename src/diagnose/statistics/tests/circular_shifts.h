#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"

namespace tera {

/// Circular shifts of a series of `size` samples against another, in samples: from `least` to size
/// - `least`, and at most `most` of them. A short series has fewer or none. Shifts keep the
/// autocorrelation of both series and destroy the dependence between them. They give the reference
/// distribution of the dependence tests here.
///
/// Model   shift k moves the series by least + (k + u) * stride samples, with random u. The stride
///         is at least `least`, so that shifts are nearly independent of each other and of the
///         unshifted series.
/// Omits   the seam where the end meets the beginning. One of the two series should be stationary.
/// Source  Harris 2020, "A shift test for independence in generic time series".
std::vector<std::size_t> CircularShifts(std::size_t size, std::size_t least, std::size_t most,
                                        const Stream& stream);

/// p-values of an observed statistic, from its values under shifts.
///
/// Model   p = (1 + #{shifted >= observed}) / (1 + shifts). p_tail ranks statistics beyond all
///         shifts. It equals p if at least ten shifts exceed the observed value, or with fewer than
///         50 shifts. Otherwise it is an exponential tail through the upper fifth of the shifts
///         (statistics are energies), and at most p.
/// Source  Phipson and Smyth 2010, "Permutation p-values should never be zero"; Knijnenburg et al.
///         2009, "Fewer permutations, more accurate P-values".
struct ShiftComparison {
  double p = 1, p_tail = 1;
};
ShiftComparison CompareWithShifts(double observed, std::vector<double> shifted);

}  // namespace tera
