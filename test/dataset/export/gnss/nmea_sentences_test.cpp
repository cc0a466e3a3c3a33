#include "dataset/export/gnss/nmea_sentences.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/units.h"

namespace tera {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr TimeNs kNoon_ns = 1'714'564'800 * kNsPerSecond;  // 2024-05-01 12:00:00 UTC

GnssSample Fix(double lat_deg, double lon_deg) {
  GnssSample s;
  s.lat_deg = lat_deg;
  s.lon_deg = lon_deg;
  s.alt_m = 90.25;
  s.fix = GnssFix::kRtkFixed;
  s.variance_enu_m2 = Vec3(0.0004, 0.0001, 0.0009);
  return s;
}

// The checksum of the common example sentence of NMEA 0183.
TEST(Nmea, ChecksumIsThatOfTheWellKnownExample) {
  EXPECT_EQ(NmeaSentence("GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,"),
            "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\r\n");
}

TEST(Nmea, PositionIsDegreesAndMinutesWithTheHemisphere) {
  // 46.78 deg = 46 deg 46.8 min; 71.27 deg = 71 deg 16.2 min.
  EXPECT_THAT(
      Gga(kNoon_ns, Fix(46.78, -71.27)),
      StartsWith("$GNGGA,120000.000,4646.8000000,N,07116.2000000,W,4,,,90.2500,M,0.0,M,,*"));
  EXPECT_THAT(Gga(kNoon_ns, Fix(-0.5, 0)), HasSubstr(",0030.0000000,S,00000.0000000,E,"));
}

TEST(Nmea, MinutesNeverRoundToSixty) {
  EXPECT_THAT(Gga(kNoon_ns, Fix(46.99999999999, 179.99999999999)),
              HasSubstr(",4700.0000000,N,18000.0000000,E,"));
}

TEST(Nmea, SecondsNeverRoundToSixty) {
  EXPECT_THAT(Rmc(kNoon_ns - 100, Fix(1, 2)), StartsWith("$GNRMC,120000.000,A,"));
  EXPECT_THAT(Rmc(kNoon_ns + 50'000'000, Fix(1, 2)), StartsWith("$GNRMC,120000.050,A,"));
  EXPECT_THAT(Rmc(kNoon_ns, Fix(1, 2)), HasSubstr(",010524,,,R*"));
}

TEST(Nmea, StandardDeviationsAreRootsOfTheVariances) {
  // North 10 mm, east 20 mm, up 30 mm: the longer axis points east.
  EXPECT_THAT(Gst(kNoon_ns, Fix(1, 2)),
              StartsWith("$GNGST,120000.000,,0.0200,0.0100,90.0,0.0100,0.0200,0.0300*"));
}

TEST(Nmea, WithoutAFixThereIsNoPlace) {
  EXPECT_THAT(Gga(kNoon_ns, GnssSample{}), StartsWith("$GNGGA,120000.000,,,,,0,,,,M,,M,,*"));
  EXPECT_THAT(Rmc(kNoon_ns, GnssSample{}), StartsWith("$GNRMC,120000.000,V,,,,,,,010524,,,N*"));
}

TEST(Nmea, HeadingsAreFromZeroToBelowAFullTurn) {
  EXPECT_THAT(Hdt(-90 * kDeg), StartsWith("$GNHDT,270.000,T*"));
  EXPECT_THAT(Hdt(725 * kDeg), StartsWith("$GNHDT,5.000,T*"));
  EXPECT_THAT(Hdt(-1e-9), StartsWith("$GNHDT,0.000,T*"));
}

}  // namespace
}  // namespace tera
