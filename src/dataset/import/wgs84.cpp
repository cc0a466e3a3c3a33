#include "dataset/import/wgs84.h"

#include <cmath>

namespace tera {
namespace {

constexpr double kSemiMajorAxis_m = 6378137.0;
constexpr double kFlattening = 1.0 / 298.257223563;

Vec3 EarthCentred(const GeodeticPlace& place) {
  const double e2 = kFlattening * (2.0 - kFlattening);
  const double s = std::sin(place.lat_rad), c = std::cos(place.lat_rad);
  const double normal_m = kSemiMajorAxis_m / std::sqrt(1.0 - e2 * s * s);
  return {(normal_m + place.height_m) * c * std::cos(place.lon_rad),
          (normal_m + place.height_m) * c * std::sin(place.lon_rad),
          ((1.0 - e2) * normal_m + place.height_m) * s};
}

/// Rotation from Earth-centred axes to east, north and up.
Mat3 TangentPlane(const GeodeticPlace& origin) {
  const double slat = std::sin(origin.lat_rad), clat = std::cos(origin.lat_rad);
  const double slon = std::sin(origin.lon_rad), clon = std::cos(origin.lon_rad);
  Mat3 R_WE;
  R_WE << -slon, clon, 0, -slat * clon, -slat * slon, clat, clat * clon, clat * slon, slat;
  return R_WE;
}

}  // namespace

Vec3 EnuFromGeodetic(const GeodeticPlace& place, const GeodeticPlace& origin) {
  return TangentPlane(origin) * (EarthCentred(place) - EarthCentred(origin));
}

GeodeticPlace GeodeticFromEnu(const Vec3& place_m, const GeodeticPlace& origin) {
  constexpr double e2 = kFlattening * (2.0 - kFlattening);
  constexpr int kIterations = 8;  // each is better by e2, 0.007
  const Vec3 p_E_m = TangentPlane(origin).transpose() * place_m + EarthCentred(origin);
  const double from_axis_m = p_E_m.head<2>().norm();
  GeodeticPlace place;
  place.lon_rad = std::atan2(p_E_m.y(), p_E_m.x());
  place.lat_rad = std::atan2(p_E_m.z(), (1.0 - e2) * from_axis_m);
  for (int k = 0; k < kIterations; ++k) {
    const double s = std::sin(place.lat_rad);
    const double normal_m = kSemiMajorAxis_m / std::sqrt(1.0 - e2 * s * s);
    place.lat_rad = std::atan2(p_E_m.z() + e2 * normal_m * s, from_axis_m);
  }
  const double s = std::sin(place.lat_rad);
  place.height_m = from_axis_m * std::cos(place.lat_rad) + p_E_m.z() * s -
                   kSemiMajorAxis_m * std::sqrt(1.0 - e2 * s * s);
  return place;
}

}  // namespace tera
