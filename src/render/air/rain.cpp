#include "render/air/rain.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kPerMm = 1000;
constexpr double kRainIntercept_1pm4 = 8e6, kSnowIntercept_1pm4 = 3.8e6;
constexpr double kFlakeSwelling = 2.5;

}  // namespace

double FallingParticles::CountAbove_1pm3(double diameter_m) const {
  if (intercept_1pm4_ <= 0) return 0;
  return intercept_1pm4_ / slope_1pm_ * std::exp(-slope_1pm_ * diameter_m);
}

double FallingParticles::Extinction_1pm() const {
  if (intercept_1pm4_ <= 0) return 0;
  return kPi * swelling_ * swelling_ * intercept_1pm4_ / (slope_1pm_ * slope_1pm_ * slope_1pm_);
}

double FallingParticles::DiameterAt(double least_m, double above) const {
  return std::min(least_m - std::log(above) / slope_1pm_, kLargest_m);
}

Rain::Rain(double rate_mmph)
    : FallingParticles(rate_mmph > 0 ? kRainIntercept_1pm4 : 0,
                       4.1 * kPerMm * std::pow(rate_mmph, -0.21), 1),
      rate_mmph_(rate_mmph) {}

double Rain::FallSpeed_mps(double diameter_m) {
  return std::max(9.65 - 10.3 * std::exp(-0.6 * kPerMm * diameter_m), 0.0);
}

Snowfall::Snowfall(double rate_mmph)
    : FallingParticles(rate_mmph > 0 ? kSnowIntercept_1pm4 * std::pow(rate_mmph, -0.87) : 0,
                       2.55 * kPerMm * std::pow(rate_mmph, -0.48), kFlakeSwelling) {}

}  // namespace tera
