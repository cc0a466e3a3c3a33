#include "sim/scenario/sun.h"

#include <libnova/julian_day.h>
#include <libnova/refraction.h>
#include <libnova/solar.h>
#include <libnova/transform.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kUnixEpoch_jd = 2440587.5;
constexpr double kSecondsPerDay = 86400;
constexpr double kAir_hPa = 1010, kAir_degC = 10;

}  // namespace

Vec3 ToSun(TimeNs utc_ns, const SiteOrigin& origin) {
  const double jd = kUnixEpoch_jd + ToSeconds(utc_ns) / kSecondsPerDay;
  ln_equ_posn equatorial{};
  ln_get_solar_equ_coords(jd, &equatorial);
  ln_lnlat_posn observer{.lng = origin.lon_deg, .lat = origin.lat_deg};
  ln_hrz_posn horizontal{};
  ln_get_hrz_from_equ(&equatorial, &observer, jd, &horizontal);
  const double height_rad =
      (horizontal.alt + ln_get_refraction_adj(horizontal.alt, kAir_hPa, kAir_degC)) * kDeg;
  const double from_north_rad = horizontal.az * kDeg + kPi;  // libnova counts from the south
  return {std::sin(from_north_rad) * std::cos(height_rad),
          std::cos(from_north_rad) * std::cos(height_rad), std::sin(height_rad)};
}

double ClearSunIlluminance_klx(double sin_height) {
  constexpr double kBeyondAir_klx = 127.5, kClearExtinction = 0.21;
  return sin_height > 0 ? kBeyondAir_klx * std::exp(-kClearExtinction / sin_height) : 0;
}

double Ev100OfIlluminance(double illuminance_klx) {
  constexpr double kIso = 100, kMeter_lx = 250;
  return std::log2(1000 * illuminance_klx * kIso / kMeter_lx);
}

}  // namespace tera
