#pragma once

#include "core/motion.h"
#include "core/time.h"
#include "sensors/gnss/site_frame.h"

namespace tera {

/// The unit vector to the sun from a place on earth, in W (x east, y north, z up).
///
/// Model   the sun's apparent place by libnova (Meeus 1998), of the observer on the ellipsoid, with
///         refraction at 10 degrees Celsius and 1010 hPa (Saemundsson 1986).
/// Omits   parallax (9 seconds of arc), the deflection of the vertical.
/// `utc_ns` counts from 1970-01-01; UT1 - UTC, below a second, is taken as 0.
Vec3 ToSun(TimeNs utc_ns, const SiteOrigin& origin);

/// Illuminance of the sun in a clear sky on a plane that faces it, klx.
///
/// Model   E = 127.5 exp(-0.21 / sin h), h the sun's height above the horizon; 0 below it.
/// Source  IES Calculation Procedures Committee 1984, "Recommended practice for the calculation of
///         daylight availability", eqs. 3 and 4 with the clear sky's coefficient.
double ClearSunIlluminance_klx(double sin_height);

/// The exposure value at ISO 100 that a light meter with the calibration constant C = 250 gives for
/// an illuminance (ISO 2720).
double Ev100OfIlluminance(double illuminance_klx);

}  // namespace tera
