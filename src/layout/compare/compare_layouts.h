#pragma once

#include <vector>

#include "layout/layout_report.h"

namespace tera {

/// The difference between two layouts in one figure.
struct Difference {
  FigureId figure;
  double of_first = 0, of_other = 0;  ///< means over the cycle
  double low = 0, high = 0;           ///< 95 % interval of the difference, other minus first
  /// True if the figure has an equivalent in another unit with a different verdict. The difference
  /// is then undecided.
  bool is_doubted = false;

  enum class Verdict { kBetter, kWorse, kUndecided };
  /// Verdict on the other layout. It is undecided if the interval contains zero or if `is_doubted`.
  Verdict verdict() const;
};

/// Differences of `other` from `first` in each figure that both have, over the same moments.
///
/// Model   the difference is the mean over the moments. Its interval comes from a moving-block
///         bootstrap over the moments; blocks of `block_s` preserve the correlation of consecutive
///         moments. Student's t widens the interval for few blocks. The sampling errors of both
///         layouts, taken as independent, widen it further. With fewer than two blocks the interval
///         always contains zero.
///         The seen share and the unseen volume of a zone measure the same quantity; the volume
///         also weights each moment by the zone's volume of air. A verdict on either requires the
///         same verdict on both.
/// Source  Kuensch 1989, "The jackknife and the bootstrap for general stationary observations",
///         Annals of Statistics 17(3).
/// Throws  InputError if the reports differ in cycle, moments or study.
std::vector<Difference> Compare(const LayoutReport& first, const LayoutReport& other,
                                double block_s = 2.0);

}  // namespace tera
