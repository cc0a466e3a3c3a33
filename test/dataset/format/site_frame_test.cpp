#include "dataset/format/site_frame.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

// Expected by GeographicLib's CartConvert -r -l LAT LON HEIGHT -p 9.
TEST(SiteFrame, APlaceOfTheTangentPlaneIsWhereCartConvertPutsIt) {
  const SiteFrame quebec(46.78, -71.27, 90);
  const SiteFrame::Geodetic near = quebec.ToGeodetic({5, 3, 2});
  EXPECT_NEAR(near.lat_deg, 46.78002698612668, 1e-13);
  EXPECT_NEAR(near.lon_deg, -71.26993452813689, 1e-13);
  EXPECT_NEAR(near.height_m, 92.000002662, 1e-8);
  const SiteFrame::Geodetic far = quebec.ToGeodetic({-1234.5, 678.25, -9.5});
  EXPECT_NEAR(far.lat_deg, 46.78609998363731, 1e-13);
  EXPECT_NEAR(far.height_m, 80.655367404, 1e-8);
  const SiteFrame::Geodetic sydney = SiteFrame(-33.9, 151.2, 25).ToGeodetic({120, -450, 30});
  EXPECT_NEAR(sydney.lat_deg, -33.90405691346276, 1e-13);
  EXPECT_NEAR(sydney.lon_deg, 151.20129744711502, 1e-13);
  EXPECT_NEAR(sydney.height_m, 55.017059160, 1e-8);
}

TEST(SiteFrame, ThePoleSeenFromTheEquatorIsThePolarRadiusAway) {
  // From (0, 0) east is y, north is z, up is x of the Earth-centred frame; polar radius b.
  const Vec3 enu_m = SiteFrame(0, 0, 0).ToEnu({90, 17, 0});
  EXPECT_NEAR(enu_m.x(), 0, 1e-6);
  EXPECT_NEAR(enu_m.y(), 6356752.314245, 1e-5);
  EXPECT_NEAR(enu_m.z(), -6378137.0, 1e-6);
}

TEST(SiteFrame, ThereAndBackIsTheSamePlace) {
  const SiteFrame site(47, 8, 400);
  const Vec3 place_m(700, -900, 40);
  EXPECT_TRUE(site.ToEnu(site.ToGeodetic(place_m)).isApprox(place_m, 1e-10));
}

}  // namespace
}  // namespace tera
