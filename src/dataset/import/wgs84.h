#pragma once

#include "core/motion.h"

namespace tera {

/// A place on WGS 84, height above the ellipsoid.
struct GeodeticPlace {
  double lat_rad = 0, lon_rad = 0, height_m = 0;
};

/// East, north and up of `place` in the tangent plane at `origin`.
///
/// Model   geodetic to Earth-centred coordinates in closed form, then rotation into the tangent
///         plane.
/// Source  Hofmann-Wellenhof et al. 2008, "GNSS", section 8.2.
Vec3 EnuFromGeodetic(const GeodeticPlace& place, const GeodeticPlace& origin);

/// The inverse.
///
/// Model   latitude by fixed-point iteration from Earth-centred coordinates, to 1e-15 rad within
///         10 km of the ellipsoid.
/// Source  the same.
GeodeticPlace GeodeticFromEnu(const Vec3& place_m, const GeodeticPlace& origin);

}  // namespace tera
