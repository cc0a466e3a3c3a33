#pragma once

#include <cstddef>
#include <vector>

#include "layout/measures/figure_id.h"

namespace tera {

/// A measure of a layout's quality at every moment of a cycle.
struct Figure {
  FigureId id;                  ///< unique in a layout
  std::vector<double> at = {};  ///< one per moment
  /// 1 sigma due to the sampling of places, one per moment; empty if unknown.
  std::vector<double> error = {};
};

double MeanOf(const Figure& figure);
/// The value at the worst moment.
double WorstOf(const Figure& figure);
/// Index of the worst moment, the first of several.
std::size_t WorstMomentOf(const Figure& figure);
/// 1 sigma of the mean due to the sampling of places. The places are the same at every moment, so
/// the errors do not average out.
double ErrorOf(const Figure& figure);

/// 1 sigma of a uniform distribution of this width.
double EvenSigma(double width);

/// Standard error of a share counted over `count` random places of equal weight.
double ShareError(double share, double count);
/// Number of places of equal weight that are as certain as these weights: (sum w)^2 / sum w^2.
///
/// Source  Kish 1965, "Survey sampling".
double LikeCount(const std::vector<double>& weights);

}  // namespace tera
