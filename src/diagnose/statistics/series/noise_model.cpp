#include "diagnose/statistics/series/noise_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/units.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr std::size_t kLongestResponse = 2000;  ///< longest impulse response, in samples

constexpr double kLowestDof = 1.5, kHighestDof = 200;

/// Samples with `order` valid samples directly before them.
std::vector<std::size_t> RowsWithMemory(const Mask& valid, std::size_t order) {
  std::vector<std::size_t> rows;
  for (const Segment& segment : SegmentsOf(valid, order + 1)) {
    for (std::size_t k = segment.begin + order; k < segment.end; ++k) rows.push_back(k);
  }
  return rows;
}

/// Weighted products of (x_t, x_(t-1), .. x_(t-order)) with themselves.
Eigen::MatrixXd LagProducts(const std::vector<double>& x, const std::vector<std::size_t>& rows,
                            const std::vector<double>& weight, std::size_t order) {
  const auto width = static_cast<Eigen::Index>(order + 1);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(width, width);
  Eigen::VectorXd lags(width);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (Eigen::Index i = 0; i < width; ++i) lags[i] = x[rows[r] - static_cast<std::size_t>(i)];
    sum.selfadjointView<Eigen::Lower>().rankUpdate(lags, weight[r]);
  }
  return sum.selfadjointView<Eigen::Lower>();
}

/// Least-squares coefficients of one order, from the products of a higher order.
Eigen::VectorXd Coefficients(const Eigen::MatrixXd& products, Eigen::Index order) {
  Eigen::MatrixXd normal = products.block(1, 1, order, order);
  normal.diagonal().array() += 1e-12 * (products(0, 0) + 1e-300);
  return normal.ldlt().solve(products.col(0).segment(1, order));
}

double ErrorEnergy(const Eigen::MatrixXd& products, const Eigen::VectorXd& ar) {
  return products(0, 0) - ar.dot(products.col(0).segment(1, ar.size()));
}

std::size_t OrderByBic(const Eigen::MatrixXd& products, double rows) {
  std::size_t best = 0;
  double least = INFINITY;
  for (Eigen::Index order = 0; order < products.rows(); ++order) {
    const double energy = ErrorEnergy(products, Coefficients(products, order));
    const double bic = rows * std::log(std::max(energy, 1e-300)) + order * std::log(rows);
    if (bic < least) {
      least = bic;
      best = static_cast<std::size_t>(order);
    }
  }
  return best;
}

std::vector<double> Errors(const std::vector<double>& x, const std::vector<std::size_t>& rows,
                           const std::vector<double>& ar) {
  std::vector<double> error(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    error[r] = x[rows[r]];
    for (std::size_t i = 0; i < ar.size(); ++i) error[r] -= ar[i] * x[rows[r] - 1 - i];
  }
  return error;
}

/// The scale that maximises the likelihood for a given dof, by EM steps from `scale`.
double ScaleAt(const std::vector<double>& error, double dof, double scale) {
  for (int step = 0; step < 12; ++step) {
    double sum = 0;
    for (const double e : error) sum += (dof + 1) * e * e / (dof + e * e / (scale * scale));
    scale = std::sqrt(sum / static_cast<double>(error.size()));
  }
  return scale;
}

/// The dof that maximises the profile likelihood of at most 4000 of the errors, by golden-section
/// search in 1 / dof.
double DofOf(const std::vector<double>& error, double scale) {
  std::vector<double> some;
  const std::size_t stride = error.size() / 4000 + 1;
  for (std::size_t k = 0; k < error.size(); k += stride) some.push_back(error[k]);
  const auto fault = [&](double inverse) {
    const double s = ScaleAt(some, 1 / inverse, scale);
    double sum = 0;
    for (const double e : some) sum -= StudentLogDensity(e / s, 1 / inverse) - std::log(s);
    return sum;
  };
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double low = 1 / kHighestDof, high = 1 / kLowestDof;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = fault(a), at_b = fault(b);
  for (int step = 0; step < 14; ++step) {
    const bool left = at_a < at_b;
    (left ? high : low) = left ? b : a;
    (left ? b : a) = left ? a : b;
    (left ? at_b : at_a) = left ? at_a : at_b;
    double& fresh = left ? a : b;
    fresh = left ? high - golden * (high - low) : low + golden * (high - low);
    (left ? at_a : at_b) = fault(fresh);
  }
  return 2 / (low + high);
}

/// Reflection coefficients of a predictor. It is stationary if and only if all magnitudes are below
/// 1.
std::vector<double> ReflectionsOf(std::vector<double> ar) {
  std::vector<double> reflection(ar.size());
  for (std::size_t order = ar.size(); order > 0; --order) {
    const double k = std::clamp(ar[order - 1], -0.9999, 0.9999);
    reflection[order - 1] = k;
    std::vector<double> shorter(order - 1);
    for (std::size_t i = 0; i + 1 < order; ++i) {
      shorter[i] = (ar[i] + k * ar[order - 2 - i]) / (1 - k * k);
    }
    ar = std::move(shorter);
  }
  return reflection;
}

std::vector<double> Longer(const std::vector<double>& ar, double reflection) {
  std::vector<double> longer(ar.size() + 1);
  for (std::size_t i = 0; i < ar.size(); ++i) {
    longer[i] = ar[i] - reflection * ar[ar.size() - 1 - i];
  }
  longer.back() = reflection;
  return longer;
}

/// The highest order with at least ten rows per coefficient.
std::size_t UsableOrder(const Mask& valid, std::size_t wanted) {
  while (wanted > 0 && RowsWithMemory(valid, wanted).size() < 10 * (wanted + 1)) --wanted;
  return wanted;
}

}  // namespace

double VarianceOf(const NoiseModel& noise) {
  std::vector<double> response = {1};
  double sum = 1;
  for (std::size_t k = 1; k < kLongestResponse; ++k) {
    double next = 0;
    for (std::size_t i = 0; i < std::min(noise.order(), k); ++i) {
      next += noise.ar[i] * response[k - 1 - i];
    }
    response.push_back(next);
    sum += next * next;
  }
  return sum * noise.scale * noise.scale * noise.dof / (noise.dof - 2);
}

double LongRunVarianceOf(const NoiseModel& noise) {
  double left = 1;
  for (const double a : noise.ar) left -= a;
  return std::pow(noise.scale / left, 2) * noise.dof / (noise.dof - 2);
}

double StudentLogDensity(double x, double dof) {
  // std::lgamma stores the sign in a global variable, which threads share.
  int sign = 1;
  return lgamma_r((dof + 1) / 2, &sign) - lgamma_r(dof / 2, &sign) - 0.5 * std::log(dof * kPi) -
         (dof + 1) / 2 * std::log1p(x * x / dof);
}

ShorterPredictors PredictorsOf(const std::vector<double>& ar) {
  const std::vector<double> reflection = ReflectionsOf(ar);
  ShorterPredictors out;
  out.ar.emplace_back();
  for (const double k : reflection) out.ar.push_back(Longer(out.ar.back(), k));
  out.variance_ratio.assign(ar.size() + 1, 1.0);
  for (std::size_t k = ar.size(); k > 0; --k) {
    out.variance_ratio[k - 1] = out.variance_ratio[k] / (1 - reflection[k - 1] * reflection[k - 1]);
  }
  return out;
}

NoiseModel FitNoise(const Series& series, const NoiseFitOptions& options) {
  TERA_CHECK(CountValid(series.valid) >= 16, CountValid(series.valid));
  NoiseModel noise;
  const std::vector<double> known = ValidValues(series);
  if (options.estimate_mean) {
    for (const double x : known) noise.mean += x / static_cast<double>(known.size());
  }
  std::vector<double> x = series.value;
  for (double& value : x) value -= noise.mean;

  std::size_t order = UsableOrder(series.valid, options.order.value_or(options.highest_order));
  bool order_open = !options.order;
  std::vector<std::size_t> rows = RowsWithMemory(series.valid, order);
  std::vector<double> weight(rows.size(), 1.0);
  for (int step = 0; step < 10; ++step) {
    const Eigen::MatrixXd products = LagProducts(x, rows, weight, order);
    if (order_open && step == 2) {
      order = OrderByBic(products, static_cast<double>(rows.size()));
      order_open = false;
      rows = RowsWithMemory(series.valid, order);
      weight.assign(rows.size(), 1.0);
      continue;
    }
    const Eigen::VectorXd ar = Coefficients(products, static_cast<Eigen::Index>(order));
    noise.ar.assign(ar.begin(), ar.end());
    const std::vector<double> error = Errors(x, rows, noise.ar);
    if (step == 0) noise.scale = std::max(RobustScale(error), 1e-300);
    if (step % 3 == 0) noise.dof = std::max(DofOf(error, noise.scale), options.least_dof);
    noise.scale = std::max(ScaleAt(error, noise.dof, noise.scale), 1e-300);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double e = error[r] / noise.scale;
      weight[r] = (noise.dof + 1) / (noise.dof + e * e);
    }
  }
  noise.ar = PredictorsOf(noise.ar).ar.back();
  return noise;
}

}  // namespace tera
