#pragma once

#include <cstddef>
#include <vector>

#include "layout/measures/figure_id.h"

namespace tera {

/// One scalar measure of a layout, with a value at each moment of a cycle.
struct Figure {
  FigureId id;                  ///< unique within a layout
  std::vector<double> at = {};  ///< one per moment
  /// 1 sigma due to the random sampling of places, one per moment. Empty if unknown.
  std::vector<double> error = {};
};

double MeanOf(const Figure& figure);
double WorstOf(const Figure& figure);
/// Index of the worst moment; the first in a tie.
std::size_t WorstMomentOf(const Figure& figure);
/// 1 sigma of MeanOf due to the sampling of places. All moments use the same places, so the errors
/// do not average out.
double ErrorOf(const Figure& figure);

/// 1 sigma of a uniform distribution of this width.
double EvenSigma(double width);

/// Standard error of a share that is counted over `count` random places.
double ShareError(double share, double count);
/// Effective sample size of weighted places: (sum w)^2 / sum w^2.
///
/// Source  Kish 1965, "Survey sampling".
double LikeCount(const std::vector<double>& weights);

}  // namespace tera
