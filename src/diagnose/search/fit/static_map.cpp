#include "diagnose/search/fit/static_map.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace tera {
namespace {

constexpr double kLongestDeadTime_s = 0.8;  ///< the longest delay that is looked for
constexpr double kDeadTimeStep_s = 0.02;
constexpr std::size_t kMostRows = 4000;  ///< enough to determine forty numbers
/// Weight of second differences over the mean energy of a hat, and a ridge that keeps the solution
/// finite.
constexpr double kBend = 1e-1, kRidge = 1e-9;

/// Adds the penalty on second differences of each direction's map, which starts at zero.
void Straighten(double weight, Eigen::MatrixXd* information) {
  for (Eigen::Index first = 0; first < 2 * kMapKnots; first += kMapKnots) {
    for (Eigen::Index k = 0; k + 1 < kMapKnots; ++k) {
      Eigen::VectorXd bend = Eigen::VectorXd::Zero(information->rows());
      if (k > 0) bend[first + k - 1] = 1;
      bend[first + k] = -2;
      bend[first + k + 1] = 1;
      *information += weight * bend * bend.transpose();
    }
  }
}

Eigen::VectorXd MapOf(const MapProducts& products) {
  Eigen::MatrixXd information = products.information;
  const double mean = information.trace() / static_cast<double>(information.rows());
  Straighten(kBend * mean, &information);
  information.diagonal().array() += kRidge * mean + 1e-300;
  return information.ldlt().solve(products.pull);
}

}  // namespace

Eigen::MatrixXd HatsOf(const Series& lever, double lag_s) {
  const auto rows = static_cast<Eigen::Index>(lever.size());
  Eigen::MatrixXd hats = Eigen::MatrixXd::Zero(rows, 2 * kMapKnots);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const double u = lever.value[static_cast<std::size_t>(k)];
    const Eigen::Index first = u < 0 ? kMapKnots : 0;
    const double at = std::min(std::abs(u), 1.0) * kMapKnots;
    const auto below = static_cast<Eigen::Index>(at);
    const double share = at - static_cast<double>(below);
    if (below > 0) hats(k, first + below - 1) = 1 - share;
    if (below < kMapKnots) hats(k, first + below) = share;
  }
  if (lag_s <= 0) return hats;
  const double keeps = std::exp(-lever.period_s / lag_s);
  for (Eigen::Index k = 1; k < rows; ++k) {
    hats.row(k) = keeps * hats.row(k - 1) + (1 - keeps) * hats.row(k);
  }
  return hats;
}

MapProducts ProductsOf(const Eigen::MatrixXd& hats, const Series& measured,
                       const std::vector<Eigen::Index>& rows, Eigen::Index late,
                       const Eigen::VectorXd& weight) {
  Eigen::MatrixXd x(static_cast<Eigen::Index>(rows.size()), hats.cols());
  Eigen::VectorXd y(x.rows());
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const Eigen::Index row = rows[static_cast<std::size_t>(i)];
    y[i] = measured.value[static_cast<std::size_t>(row)];
    x.row(i) = weight[row] * hats.row(std::max<Eigen::Index>(0, row - late));
  }
  MapProducts products;
  products.information = x.transpose() * x;
  products.pull = x.transpose() * y;
  products.energy = y.squaredNorm();
  return products;
}

std::vector<Eigen::Index> RowsOf(const Series& measured, const Mask& mask, std::size_t most) {
  std::vector<Eigen::Index> all;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    if (mask[k] && measured.valid[k]) all.push_back(static_cast<Eigen::Index>(k));
  }
  const std::size_t stride = (all.size() + most - 1) / most;
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < all.size(); i += stride) rows.push_back(all[i]);
  return rows;
}

PlainMap FitPlainMap(const Series& lever, const Series& measured, const Mask& seen) {
  const Eigen::MatrixXd hats = HatsOf(lever, 0);
  const std::vector<Eigen::Index> rows = RowsOf(measured, seen, kMostRows);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(hats.rows());
  const auto step = std::max<Eigen::Index>(1, std::lround(kDeadTimeStep_s / lever.period_s));
  const auto longest = static_cast<Eigen::Index>(kLongestDeadTime_s / lever.period_s);
  double least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd best = Eigen::VectorXd::Zero(hats.cols());
  Eigen::Index late = 0;
  for (Eigen::Index shift = 0; shift <= longest && !rows.empty(); shift += step) {
    const MapProducts products = ProductsOf(hats, measured, rows, shift, ones);
    const Eigen::VectorXd map = MapOf(products);
    const double left =
        products.energy - 2 * map.dot(products.pull) + map.dot(products.information * map);
    if (left >= least) continue;
    least = left;
    best = map;
    late = shift;
  }
  const Eigen::VectorXd mapped = hats * best;
  PlainMap plain{static_cast<double>(late) * lever.period_s, std::vector<double>(lever.size())};
  for (Eigen::Index k = 0; k < mapped.size(); ++k) {
    plain.predicted[static_cast<std::size_t>(k)] = mapped[std::max<Eigen::Index>(0, k - late)];
  }
  return plain;
}

}  // namespace tera
