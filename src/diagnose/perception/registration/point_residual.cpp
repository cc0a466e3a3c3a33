#include "diagnose/perception/registration/point_residual.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr double kDegreesOfFreedom = 4;
constexpr double kFurthest = 30;     ///< sigmas: a point further away is no further evidence
constexpr double kLeastScale = 0.2;  ///< noise cannot be far below that of the sensor's model
constexpr double kInlierShare = 0.95;
constexpr double kSigmaOfMad = 1.4826;  ///< of normal noise, over its median absolute deviation

}  // namespace

double LogDensityAt(double distance_over_sigma) {
  const double x = std::min(std::abs(distance_over_sigma), kFurthest);
  return -0.5 * (kDegreesOfFreedom + 1) * std::log1p(x * x / kDegreesOfFreedom);
}

double LogLikelihoodOf(const PointResidual& residual, double scale) {
  if (!residual.is_judged()) return LogDensityAt(kFurthest);
  return LogDensityAt(residual.distance / (scale * residual.sigma));
}

double LogLikelihoodOf(const std::vector<PointResidual>& residuals, double scale) {
  double sum = 0;
  for (const PointResidual& residual : residuals) sum += LogLikelihoodOf(residual, scale);
  return sum;
}

double ScaleOf(const std::vector<PointResidual>& residuals) {
  std::vector<double> distances;
  for (const PointResidual& r : residuals) {
    if (r.is_judged()) distances.push_back(std::abs(r.distance / r.sigma));
  }
  if (distances.empty()) return 1;
  return std::max(kLeastScale, kSigmaOfMad * Median(std::move(distances)));
}

double TrimmedRmse(const std::vector<PointResidual>& residuals) {
  std::vector<double> square;
  for (const PointResidual& r : residuals) {
    if (r.is_judged()) square.push_back(r.distance * r.distance);
  }
  if (square.empty()) return 0;
  const auto kept =
      static_cast<std::size_t>(std::ceil(kInlierShare * static_cast<double>(square.size())));
  std::nth_element(square.begin(), square.begin() + static_cast<std::ptrdiff_t>(kept) - 1,
                   square.end());
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += square[i];
  return std::sqrt(sum / static_cast<double>(kept));
}

double RobustWeightOf(const PointResidual& residual, double scale) {
  const double x = residual.distance / (scale * residual.sigma);
  return (kDegreesOfFreedom + 1) / (kDegreesOfFreedom + x * x);
}

}  // namespace tera
