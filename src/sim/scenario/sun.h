#pragma once

#include "core/motion.h"
#include "core/time.h"
#include "soil/soil.h"

namespace tera {

/// The unit vector from a place on earth to the sun, in W (x east, y north, z up). `utc_ns` counts
/// from 1970-01-01.
///
/// Model   the sun's apparent position by libnova (Meeus 1998), for an observer on the ellipsoid,
///         with refraction at 10 degrees Celsius and 1010 hPa (Saemundsson 1986) down to the
///         horizon.
/// Omits   parallax (9 seconds of arc), the deflection of the vertical, UT1 - UTC (below a second).
Vec3 ToSun(TimeNs utc_ns, const SiteOrigin& origin);

/// Illuminance of the sun in a clear sky on a plane that faces it, klx.
///
/// Model   E = 127.5 exp(-0.21 / sin h), h the sun's height above the horizon; 0 below it.
/// Source  IES Calculation Procedures Committee 1984, "Recommended practice for the calculation of
///         daylight availability", eqs. 3 and 4 with the clear sky's coefficient.
double ClearSunIlluminance_klx(double sin_height);

/// Illuminance of a clear, moonless sky on level ground, without the sun itself, lx.
///
/// Model   by day the IES's clear sky, 0.8 + 15.5 sqrt(sin h) klx. Below h = 5 degrees the sum of
///         sun and sky by the source's polynomials; above the horizon the sky dominates it there.
///         From 18 degrees below the horizon on, the stars.
/// Source  IES (above), eq. 10; Janiczek and DeYoung 1987, "Computer programs for sun and moon
///         illuminance", U.S. Naval Observatory Circular 171, table 1.
double ClearSkyIlluminance_lx(double height_rad);

/// Exposure value at ISO 100 of a light meter with the calibration constant C = 250 (ISO 2720).
double Ev100OfIlluminance(double illuminance_klx);

}  // namespace tera
