#pragma once

#include "core/motion.h"
#include "core/time.h"
#include "soil/soil.h"

namespace tera {

/// Unit vector in W (x east, y north, z up) from a place on earth to the sun. `utc_ns` counts from
/// 1970-01-01.
///
/// Model   apparent position of the sun by libnova (Meeus 1998), for an observer on the ellipsoid.
///         Refraction at 10 degrees Celsius and 1010 hPa (Saemundsson 1986) applies down to the
///         horizon.
/// Omits   parallax (9 seconds of arc), the deflection of the vertical, UT1 - UTC (below a second).
Vec3 ToSun(TimeNs utc_ns, const SiteOrigin& origin);

/// Illuminance by the sun in a clear sky, on a plane that faces the sun, in klx.
///
/// Model   E = 127.5 exp(-0.21 / sin h) with the sun's elevation h; 0 below the horizon.
/// Source  IES Calculation Procedures Committee 1984, "Recommended practice for the calculation of
///         daylight availability", eqs. 3 and 4 with the clear sky's coefficient.
double ClearSunIlluminance_klx(double sin_height);

/// Illuminance of level ground by a clear, moonless sky without direct sunlight, in lx.
///
/// Model   for h above 5 degrees the IES's clear sky, 0.8 + 15.5 sqrt(sin h) klx. Below, the
///         polynomials of Janiczek and DeYoung for the sum of sun and sky; at these elevations the
///         sky dominates. From 18 degrees below the horizon on, the light of the stars.
/// Source  IES (above), eq. 10; Janiczek and DeYoung 1987, "Computer programs for sun and moon
///         illuminance", U.S. Naval Observatory Circular 171, table 1.
double ClearSkyIlluminance_lx(double height_rad);

/// Exposure value at ISO 100 that a light meter with the calibration constant C = 250 shows (ISO
/// 2720).
double Ev100OfIlluminance(double illuminance_klx);

}  // namespace tera
