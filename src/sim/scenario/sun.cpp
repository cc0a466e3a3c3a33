#include "sim/scenario/sun.h"

#include <libnova/precession.h>
#include <libnova/solar.h>
#include <libnova/transform.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kUnixEpoch_jd = 2440587.5;
constexpr double kSecondsPerDay = 86400;

/// Refraction for a true elevation (Saemundsson). It fades out below the horizon, where it has no
/// effect.
double Refraction_deg(double height_deg) {
  constexpr double kGone_deg = -2, kFade_deg = 1, kMinutes = 60;
  if (height_deg <= kGone_deg) return 0;
  const double fade = std::min(1.0, (height_deg - kGone_deg) / kFade_deg);
  return fade * 1.02 / std::tan((height_deg + 10.3 / (height_deg + 5.11)) * kDeg) / kMinutes;
}

}  // namespace

Vec3 ToSun(TimeNs utc_ns, const SiteOrigin& origin) {
  const double jd = kUnixEpoch_jd + ToSeconds(utc_ns) / kSecondsPerDay;
  ln_equ_posn of_2000{}, equatorial{};
  ln_get_solar_equ_coords(jd, &of_2000);
  ln_get_equ_prec(&of_2000, jd, &equatorial);
  ln_lnlat_posn observer{.lng = origin.lon_deg, .lat = origin.lat_deg};
  ln_hrz_posn horizontal{};
  ln_get_hrz_from_equ(&equatorial, &observer, jd, &horizontal);
  const double height_rad = (horizontal.alt + Refraction_deg(horizontal.alt)) * kDeg;
  const double from_north_rad = horizontal.az * kDeg + kPi;  // libnova counts from the south
  return {std::sin(from_north_rad) * std::cos(height_rad),
          std::cos(from_north_rad) * std::cos(height_rad), std::sin(height_rad)};
}

double ClearSunIlluminance_klx(double sin_height) {
  constexpr double kBeyondAir_klx = 127.5, kClearExtinction = 0.21;
  return sin_height > 0 ? kBeyondAir_klx * std::exp(-kClearExtinction / sin_height) : 0;
}

double ClearSkyIlluminance_lx(double height_rad) {
  struct Span {
    double from_deg, l0, l1, l2, l3;
  };
  static constexpr std::array<Span, 4> kSpans = {{{-0.8, 2.88, 22.26, -207.64, 1034.30},
                                                  {-5, 2.88, 21.81, -258.11, -858.36},
                                                  {-12, 2.70, 12.17, -431.69, -1899.83},
                                                  {-18, 13.84, 262.72, 1447.42, 2797.93}}};
  constexpr double kDay_deg = 5;
  const double height_deg = std::max(height_rad / kDeg, kSpans.back().from_deg);
  if (height_deg >= kDay_deg) return 800 + 15500 * std::sqrt(std::sin(height_rad));
  const double x = height_deg / 90;
  for (const Span& span : kSpans) {
    if (height_deg < span.from_deg) continue;
    return std::pow(10, span.l0 + x * (span.l1 + x * (span.l2 + x * span.l3)));
  }
  return 0;
}

double Ev100OfIlluminance(double illuminance_klx) {
  constexpr double kIso = 100, kMeter_lx = 250;
  return std::log2(1000 * illuminance_klx * kIso / kMeter_lx);
}

}  // namespace tera
