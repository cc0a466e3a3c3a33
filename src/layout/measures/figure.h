#pragma once

#include <cstddef>
#include <vector>

#include "layout/measures/figure_id.h"

namespace tera {

/// A number that says how well a layout does something, at every moment of a cycle.
struct Figure {
  FigureId id;                  ///< unique in a layout
  std::vector<double> at = {};  ///< of each moment
  /// Of each, 1 sigma by the places that were tried; empty where none is known.
  std::vector<double> error = {};
};

double MeanOf(const Figure& figure);
/// Of the moment at which it is worst.
double WorstOf(const Figure& figure);
/// Number of the moment at which it is worst, the first of several.
std::size_t WorstMomentOf(const Figure& figure);
/// 1 sigma of the mean by the places that were tried: these are the same at every moment, so that
/// the errors do not average out.
double ErrorOf(const Figure& figure);

/// 1 sigma of what lies anywhere within a width, evenly.
double EvenSigma(double width);

/// Standard error of a share counted over `count` places drawn at random, all of one weight.
double ShareError(double share, double count);
/// How many places of one weight are as certain as places of these weights: (sum w)^2 / sum w^2.
///
/// Source  Kish 1965, "Survey sampling".
double LikeCount(const std::vector<double>& weights);

}  // namespace tera
