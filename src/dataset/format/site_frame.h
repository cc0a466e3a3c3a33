#pragma once

#include <memory>

#include "core/motion.h"

namespace tera {

/// The world's position on Earth.
///
/// Frames  W local east-north-up: its origin at the geodetic position, z along the ellipsoid's
///         normal there. Geodetic: WGS 84, degrees, height above the ellipsoid.
/// Model   W to Earth-centred Cartesian by one rigid motion, then to geodetic. W is a plane: the
///         ellipsoid falls away from z = 0 by d^2 / 2R, 8 cm at 1 km.
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
