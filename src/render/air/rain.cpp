#include "render/air/rain.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kIntercept_1pm4 = 8e6;
constexpr double kPerMm = 1000;

}  // namespace

Rain::Rain(double rate_mmph)
    : rate_mmph_(rate_mmph), slope_1pm_(4.1 * kPerMm * std::pow(rate_mmph, -0.21)) {}

double Rain::CountAbove_1pm3(double diameter_m) const {
  if (rate_mmph_ <= 0) return 0;
  return kIntercept_1pm4 / slope_1pm_ * std::exp(-slope_1pm_ * diameter_m);
}

double Rain::Extinction_1pm() const {
  if (rate_mmph_ <= 0) return 0;
  return kPi * kIntercept_1pm4 / (slope_1pm_ * slope_1pm_ * slope_1pm_);
}

double Rain::DiameterAt(double least_m, double above) const {
  return std::min(least_m - std::log(above) / slope_1pm_, kLargest_m);
}

double Rain::FallSpeed_mps(double diameter_m) {
  return std::max(9.65 - 10.3 * std::exp(-0.6 * kPerMm * diameter_m), 0.0);
}

}  // namespace tera
