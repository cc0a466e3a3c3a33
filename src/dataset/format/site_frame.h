#pragma once

#include <memory>

#include "core/motion.h"

namespace tera {

/// Conversion between the world frame and geodetic coordinates.
///
/// Frames  W local east-north-up: its origin is at the geodetic position, and z is the normal of
///         the ellipsoid there. Geodetic coordinates are WGS 84 in degrees, with height above the
///         ellipsoid.
/// Model   One rigid motion maps W to Earth-centred Cartesian coordinates, which are converted to
///         geodetic ones. The plane z = 0 of W is tangent to the ellipsoid, which is d^2 / 2R below
///         it at distance d: 8 cm at 1 km.
/// Omits   the geoid, tides, plate motion.
/// Source  GeographicLib's LocalCartesian; Karney 2011, "Geodesics on an ellipsoid of revolution",
///         appendix B.
class SiteFrame {
 public:
  struct Geodetic {
    double lat_deg, lon_deg, height_m;
  };
  explicit SiteFrame(const Geodetic& origin);
  SiteFrame(double lat_deg, double lon_deg, double height_m)
      : SiteFrame(Geodetic{lat_deg, lon_deg, height_m}) {}
  Geodetic ToGeodetic(const Vec3& p_W_m) const;
  Vec3 ToEnu(const Geodetic& place) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace tera
