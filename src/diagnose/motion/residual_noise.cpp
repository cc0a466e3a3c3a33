#include "diagnose/motion/residual_noise.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr int kScaleIterations = 30;
constexpr double kLeastAutocorrelation = 0.05;
constexpr std::size_t kMostLags = 100;
constexpr std::size_t kFewestResiduals = 20;

struct RobustLocation {
  double mean = 0, sigma = 0;
};

RobustLocation LocationOf(const ChannelResiduals& residuals, double least, double start) {
  RobustLocation at{0, std::max(start, least)};
  for (int i = 0; i < kScaleIterations; ++i) {
    double square = 0, sum = 0, weights = 0, count = 0;
    for (const auto& segment : residuals.by_segment) {
      for (const double r : segment) {
        const double off = r - at.mean, weight = ErrorWeight(off, at.sigma);
        square += weight * off * off, sum += weight * off, weights += weight, ++count;
      }
    }
    if (count < kFewestResiduals || (square <= 0 && least <= 0)) break;
    at = {at.mean + sum / weights, std::max(std::sqrt(square / count), least)};
  }
  return at;
}

double InflationOf(const ChannelResiduals& residuals, const RobustLocation& at) {
  double inflation = 1, variance = 0;
  for (std::size_t lag = 0; lag <= kMostLags; ++lag) {
    double product = 0;
    for (const auto& segment : residuals.by_segment) {
      for (std::size_t k = lag; k < segment.size(); ++k) {
        const double a = segment[k] - at.mean, b = segment[k - lag] - at.mean;
        product += ErrorWeight(a, at.sigma) * a * ErrorWeight(b, at.sigma) * b;
      }
    }
    if (lag == 0) variance = product;
    if (variance <= 0) break;
    if (lag == 0) continue;
    if (product < kLeastAutocorrelation * variance) break;
    inflation += 2 * product / variance;
  }
  return inflation;
}

}  // namespace

double ErrorWeight(double residual, double sigma) {
  return (kErrorDof + 1) / (kErrorDof + residual * residual / (sigma * sigma));
}

void EstimateNoise(const std::vector<ChannelResiduals>& residuals,
                   std::vector<NoiseChannel>* noise) {
  for (std::size_t c = 0; c < noise->size(); ++c) {
    NoiseChannel& channel = (*noise)[c];
    const RobustLocation at = LocationOf(residuals[c], channel.least, channel.sigma);
    channel.sigma = at.sigma;
    channel.inflation = InflationOf(residuals[c], at);
  }
}

}  // namespace tera
