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

}  // namespace

Vec3 EnuFromGeodetic(const GeodeticPlace& place, const GeodeticPlace& origin) {
  const double slat = std::sin(origin.lat_rad), clat = std::cos(origin.lat_rad);
  const double slon = std::sin(origin.lon_rad), clon = std::cos(origin.lon_rad);
  Mat3 R_WE;
  R_WE << -slon, clon, 0, -slat * clon, -slat * slon, clat, clat * clon, clat * slon, slat;
  return R_WE * (EarthCentred(place) - EarthCentred(origin));
}

}  // namespace tera
