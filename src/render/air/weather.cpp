#include "render/air/weather.h"

#include <cmath>

#include "render/air/rain.h"

namespace tera {
namespace {

constexpr double kWavelength_um = 0.905, kVisible_um = 0.55;
/// Contrast that remains at the meteorological optical range (WMO-No. 8, 2018, part I, 9.1.1).
constexpr double kOpticalRangeContrast = 0.05;

}  // namespace

Vec2 Wind::towards_W() const { return {-std::sin(from_rad), -std::cos(from_rad)}; }

double Weather::Extinction_1pm() const {
  const double fog_1pm = visibility_m > 0 ? -std::log(kVisibleContrast) / visibility_m : 0;
  return fog_1pm + Rain(rain_mmph).Extinction_1pm() + Snowfall(snowfall_mmph).Extinction_1pm();
}

double FogExtinction_1pm(double visibility_m) {
  if (visibility_m <= 0) return 0;
  const double v_km = visibility_m / 1000;
  double q = 0;
  if (v_km > 50) {
    q = 1.6;
  } else if (v_km > 6) {
    q = 1.3;
  } else if (v_km > 1) {
    q = 0.16 * v_km + 0.34;
  } else if (v_km > 0.5) {
    q = v_km - 0.5;
  }
  return -std::log(kVisibleContrast) / visibility_m * std::pow(kWavelength_um / kVisible_um, -q);
}

double FogBackscatter_1pmsr(double extinction_1pm) {
  return 0.046 * extinction_1pm / -std::log(kOpticalRangeContrast);
}

}  // namespace tera
