#pragma once

#include <vector>

#include "diagnose/statistics/series/series.h"

namespace tera {

struct ChangePointOptions {
  double alpha = 0.01;  ///< probability of any change, or any interval, where there is none
  /// Innovations may be somewhat correlated: scatter from cell to cell counts as noise.
  bool guarded = true;
};

/// A segment of constant level and variance.
struct LevelSegment {
  Segment samples;
  double level = 0;         ///< mean of the location score; 0 as the noise model says
  double excess = 0;        ///< mean of the scale score; 0 as the noise model says
  double significance = 0;  ///< chi-square of two degrees of freedom, both scores against 0
  bool mismatch = false;
};

struct ChangePoints {
  std::vector<LevelSegment> segments;
  std::vector<Segment> mismatch;  ///< flagged segments, neighbours joined; in samples
};

/// Finds where in time innovations differ from the noise model, in level or in variance.
///
/// Model   e is Student-t with `dof`. Its location score is (dof + 1) e / (dof + e^2), its scale
///         score (dof + 1) e^2 / (dof + e^2) - 1. Both are bounded with mean 0. Each has unit
///         variance in cells, by the larger of theory and, where guarded, the scatter from cell to
///         cell. Minimises the sum of squares plus a penalty for each change, exactly, by pruned
///         dynamic programming (PELT). The penalty, 2 log(cells / alpha), bounds the probability of
///         a change in innovations of the noise model. It follows from the chi-square tail with two
///         degrees of freedom and a union over positions. A segment whose energy or level differs
///         from the noise by the same bound is a mismatch.
/// Omits   mismatch that is quieter than the noise.
/// Source  Killick, Fearnhead and Eckley 2012, "Optimal detection of changepoints with a linear
///         computational cost". Scores of the t distribution: Harvey 2013, "Dynamic models for
///         volatility and heavy tails".
ChangePoints FindChangePoints(const Series& innovations, double dof,
                              const ChangePointOptions& options = {});

}  // namespace tera
