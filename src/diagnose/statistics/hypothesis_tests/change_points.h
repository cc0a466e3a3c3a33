#pragma once

#include <vector>

#include "diagnose/statistics/series/series.h"

namespace tera {

struct ChangePointOptions {
  double alpha = 0.01;  ///< probability of any change or mismatch where there is none
  /// True: innovations may be slightly correlated, and scatter between cells counts as noise.
  bool guarded = true;
};

/// A segment of constant level and variance.
struct LevelSegment {
  Segment samples;
  double level = 0;         ///< mean location score; 0 under the noise model
  double excess = 0;        ///< mean scale score; 0 under the noise model
  double significance = 0;  ///< chi-square with two degrees of freedom, of both scores against 0
  bool mismatch = false;
};

struct ChangePoints {
  std::vector<LevelSegment> segments;
  std::vector<Segment> mismatch;  ///< segments with a mismatch, neighbours joined; in samples
};

/// Finds the times at which innovations differ from the noise model, in level or variance.
///
/// Model   e is Student-t with `dof`. Its location score is (dof + 1) e / (dof + e^2), and its
///         scale score is (dof + 1) e^2 / (dof + e^2) - 1. Both are bounded and have mean 0. Scores
///         are averaged over cells and scaled to unit variance. The variance is the theoretical
///         one. If `guarded`, it is at least the variance of the scatter between cells.
///
///         The segmentation minimises the sum of squares plus a penalty per change, exactly, by
///         pruned dynamic programming (PELT). The penalty, 2 log(cells / alpha), bounds the
///         probability of a change under the noise model. It follows from the chi-square tail with
///         two degrees of freedom and a union bound over positions. A segment whose energy or level
///         differs from the noise by the same bound is a mismatch.
/// Omits   mismatch that is smaller than the noise.
/// Source  Killick, Fearnhead and Eckley 2012, "Optimal detection of changepoints with a linear
///         computational cost". Scores of the t distribution: Harvey 2013, "Dynamic models for
///         volatility and heavy tails".
ChangePoints FindChangePoints(const Series& innovations, double dof,
                              const ChangePointOptions& options = {});

}  // namespace tera
