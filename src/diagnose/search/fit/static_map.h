#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnose/statistics/series/series.h"

namespace tera {

/// Knots of a static map between rest and full lever, in each direction.
inline constexpr Eigen::Index kMapKnots = 20;

/// Hat functions of a lever about each knot, behind a first-order lag: one row a sample, kMapKnots
/// columns of positive levers and as many of negative ones. Their combinations are the maps through
/// the origin that are straight between knots.
Eigen::MatrixXd HatsOf(const Series& lever, double lag_s);

/// A regression of a measurement on hats of its lever some samples before.
struct MapProducts {
  Eigen::MatrixXd information;
  Eigen::VectorXd pull;
  double energy = 0;  ///< of the measurement
};

/// Over some rows, each of the hats' rows times its weight.
MapProducts ProductsOf(const Eigen::MatrixXd& hats, const Series& measured,
                       const std::vector<Eigen::Index>& rows, Eigen::Index late,
                       const Eigen::VectorXd& weight);

/// The valid samples of a mask, evenly thinned to `most` at most.
std::vector<Eigen::Index> RowsOf(const Series& measured, const Mask& mask, std::size_t most);

/// The rate that a dead time and a static map predict from a lever.
struct PlainMap {
  double dead_time_s = 0;
  std::vector<double> predicted;
};

/// A dead time and a static map of the lever, by least squares over the samples of a mask: what an
/// engineer fits first, and what any better model must do better than.
///
/// Model   dead times up to 0.8 s, each with its best map; second differences of the map have a
///         faint penalty, by which knots that no lever reached lie on the line of their neighbours.
PlainMap FitPlainMap(const Series& lever, const Series& measured, const Mask& seen);

}  // namespace tera
