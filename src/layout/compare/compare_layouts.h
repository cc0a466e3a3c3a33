#pragma once

#include <vector>

#include "layout/layout_report.h"

namespace tera {

/// A difference of two layouts in one figure.
struct Difference {
  FigureId figure;
  double of_first = 0, of_other = 0;  ///< means over the cycle
  double low = 0, high = 0;           ///< 95 % interval of the other's mean less the first's
  /// Another figure says the same in another unit, and cannot show a difference: neither does this.
  bool is_doubted = false;

  enum class Verdict { kBetter, kWorse, kUndecided };
  /// Of the other: undecided where the interval holds zero, or where it is doubted.
  Verdict verdict() const;
};

/// What `other` does otherwise than `first` over the same moments, in each figure that both have.
///
/// Model   the mean of the differences of single moments; its interval by a moving-block bootstrap
///         over them, blocks of `block_s` because moments that follow each other are alike, as wide
///         as so few blocks ask (Student's t), and widened by the sampling errors of both, which
///         are taken as independent. Of less than two blocks it holds zero. The share of a zone
///         that is seen and the volume of it that is not are one quantity, but that the volume
///         weighs moments by how much air the zone then has: each is decided only where both are.
/// Source  Kuensch 1989, "The jackknife and the bootstrap for general stationary observations",
///         Annals of Statistics 17(3).
///
/// Throws InputError where they are not of the same cycle, the same moments and the same study.
std::vector<Difference> Compare(const LayoutReport& first, const LayoutReport& other,
                                double block_s = 2.0);

}  // namespace tera
