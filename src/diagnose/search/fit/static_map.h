#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnose/statistics/series/series.h"

namespace tera {

/// Knots of a static map between neutral and full lever, in each direction.
inline constexpr Eigen::Index kMapKnots = 20;

/// Hat functions of a lever about each knot, after a first-order lag. Rows: samples. Columns:
/// kMapKnots of positive levers, then as many of negative ones. Their combinations are the
/// piecewise-linear maps through the origin.
Eigen::MatrixXd HatsOf(const Series& lever, double lag_s);

/// Normal equations of a measurement on hats of its lever, delayed by some samples.
struct MapProducts {
  Eigen::MatrixXd information;
  Eigen::VectorXd pull;
  double energy = 0;  ///< of the measurement
};

/// Over some rows, with each row of the hats scaled by its weight.
MapProducts ProductsOf(const Eigen::MatrixXd& hats, const Series& measured,
                       const std::vector<Eigen::Index>& rows, Eigen::Index late,
                       const Eigen::VectorXd& weight);

/// The valid samples of a mask, evenly thinned to at most `most`.
std::vector<Eigen::Index> RowsOf(const Series& measured, const Mask& mask, std::size_t most);

/// The rate that a dead time and a static map predict from a lever.
struct PlainMap {
  double dead_time_s = 0;
  std::vector<double> predicted;
};

/// Least-squares fit of a dead time and a static map of the lever to the samples of a mask. This is
/// an engineer's first fit, and every better model must beat it.
///
/// Model   dead times up to 0.8 s, each with its best map. A faint penalty on second differences of
///         the map interpolates knots that no lever reached.
PlainMap FitPlainMap(const Series& lever, const Series& measured, const Mask& seen);

}  // namespace tera
