#pragma once

#include <vector>

#include "layout/layout_report.h"

namespace tera {

/// A difference between two layouts in one figure.
struct Difference {
  FigureId figure;
  double of_first = 0, of_other = 0;  ///< means over the cycle
  double low = 0, high = 0;           ///< 95 % interval of the other's mean minus the first's
  /// An equivalent figure in another unit shows no difference, so this one does not count either.
  bool is_doubted = false;

  enum class Verdict { kBetter, kWorse, kUndecided };
  /// Verdict on the other layout: undecided if the interval holds zero or the difference is
  /// doubted.
  Verdict verdict() const;
};

/// Differences of `other` from `first` over the same moments, in each figure that both have.
///
/// Model   the mean of the differences at single moments. Its interval is a moving-block bootstrap
///         over the moments, with blocks of `block_s` because consecutive moments correlate.
///         Student's t widens it for few blocks, and the independent sampling errors of both
///         layouts widen it further. With fewer than two blocks it holds zero. The seen share and
///         the unseen volume of a zone are one quantity, except that the volume weights moments by
///         the zone's air. Each is decided only if both are.
/// Source  Kuensch 1989, "The jackknife and the bootstrap for general stationary observations",
///         Annals of Statistics 17(3).
/// Throws  InputError if the reports differ in cycle, moments or study.
std::vector<Difference> Compare(const LayoutReport& first, const LayoutReport& other,
                                double block_s = 2.0);

}  // namespace tera
