#include "dataset/import/wgs84.h"

#include <gtest/gtest.h>

#include "core/units.h"

namespace tera {
namespace {

// Expected by GeographicLib's CartConvert -r -l LAT LON HEIGHT -p 9.
TEST(Wgs84, APlaceOfTheTangentPlaneIsWhereGeographicLibPutsIt) {
  const GeodeticPlace quebec = GeodeticFromEnu({5, 3, 2}, {46.78 * kDeg, -71.27 * kDeg, 90});
  EXPECT_NEAR(quebec.lat_rad / kDeg, 46.78002698612668, 1e-13);
  EXPECT_NEAR(quebec.lon_rad / kDeg, -71.26993452813689, 1e-13);
  EXPECT_NEAR(quebec.height_m, 92.000002662, 1e-8);
  const GeodeticPlace far =
      GeodeticFromEnu({-1234.5, 678.25, -9.5}, {46.78 * kDeg, -71.27 * kDeg, 90});
  EXPECT_NEAR(far.lat_rad / kDeg, 46.78609998363731, 1e-13);
  EXPECT_NEAR(far.height_m, 80.655367404, 1e-8);
  const GeodeticPlace sydney = GeodeticFromEnu({120, -450, 30}, {-33.9 * kDeg, 151.2 * kDeg, 25});
  EXPECT_NEAR(sydney.lat_rad / kDeg, -33.90405691346276, 1e-13);
  EXPECT_NEAR(sydney.lon_rad / kDeg, 151.20129744711502, 1e-13);
  EXPECT_NEAR(sydney.height_m, 55.017059160, 1e-8);
}

TEST(Wgs84, ThereAndBackIsTheSamePlace) {
  const GeodeticPlace origin = {47 * kDeg, 8 * kDeg, 400};
  const Vec3 place_m(700, -900, 40);
  EXPECT_TRUE(EnuFromGeodetic(GeodeticFromEnu(place_m, origin), origin).isApprox(place_m, 1e-10));
}

}  // namespace
}  // namespace tera
