#include "diagnose/motion/residual_noise.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr int kScaleIterations = 30;
constexpr double kLeastAutocorrelation = 0.05;
constexpr std::size_t kMostLags = 100;
constexpr std::size_t kFewestResiduals = 20;

double ScaleOf(const ChannelResiduals& residuals, double least, double start) {
  double sigma = std::max(start, least);
  for (int i = 0; i < kScaleIterations; ++i) {
    double square = 0, count = 0;
    for (const auto& segment : residuals.by_segment) {
      for (const double r : segment) square += ErrorWeight(r, sigma) * r * r, ++count;
    }
    if (count < kFewestResiduals || (square <= 0 && least <= 0)) break;
    sigma = std::max(std::sqrt(square / count), least);
  }
  return sigma;
}

double InflationOf(const ChannelResiduals& residuals, double sigma) {
  double inflation = 1, variance = 0;
  for (std::size_t lag = 0; lag <= kMostLags; ++lag) {
    double product = 0;
    for (const auto& segment : residuals.by_segment) {
      for (std::size_t k = lag; k < segment.size(); ++k) {
        const double a = segment[k], b = segment[k - lag];
        product += ErrorWeight(a, sigma) * a * ErrorWeight(b, sigma) * b;
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
    channel.sigma = ScaleOf(residuals[c], channel.least, channel.sigma);
    channel.inflation = InflationOf(residuals[c], channel.sigma);
  }
}

}  // namespace tera
