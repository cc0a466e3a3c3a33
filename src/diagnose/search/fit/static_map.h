#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnose/statistics/series/series.h"

namespace tera {

/// Knots of a static map in each direction, between neutral and full lever.
inline constexpr Eigen::Index kMapKnots = 20;

/// Hat functions of a lever about each knot, after a first-order lag. Rows: samples. Columns:
/// kMapKnots of positive levers, then as many of negative ones. Linear combinations are
/// piecewise-linear maps through the origin.
Eigen::MatrixXd HatsOf(const Series& lever, double lag_s);

/// Normal equations of a measurement on delayed hats of its lever.
struct MapProducts {
  Eigen::MatrixXd information;
  Eigen::VectorXd pull;
  double energy = 0;  ///< sum of squares of the measurement
};

/// Normal equations over some rows. `late` delays the lever by samples; `weight` scales the rows of
/// the hats.
MapProducts ProductsOf(const Eigen::MatrixXd& hats, const Series& measured,
                       const std::vector<Eigen::Index>& rows, Eigen::Index late,
                       const Eigen::VectorXd& weight);

/// The valid samples of a mask, thinned evenly to at most `most`.
std::vector<Eigen::Index> RowsOf(const Series& measured, const Mask& mask, std::size_t most);

/// The rate predicted from a lever by a dead time and a static map.
struct PlainMap {
  double dead_time_s = 0;
  std::vector<double> predicted;
};

/// Least-squares fit of a dead time and a static map of the lever to the samples of a mask. An
/// engineer would fit this first; every better model must beat it.
///
/// Model   dead times up to 0.8 s, each with its best map. A faint penalty on second differences of
///         the map interpolates knots that the lever never reaches.
PlainMap FitPlainMap(const Series& lever, const Series& measured, const Mask& seen);

}  // namespace tera
