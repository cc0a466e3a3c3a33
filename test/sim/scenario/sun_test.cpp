#include "sim/scenario/sun.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "core/utc_time.h"

namespace tera {
namespace {

double Height_deg(const Vec3& to_sun_W) { return std::asin(to_sun_W.z()) / kDeg; }
double Azimuth_deg(const Vec3& to_sun_W) {
  const double turn = std::atan2(to_sun_W.x(), to_sun_W.y()) / kDeg;
  return turn < 0 ? turn + 360 : turn;
}

TEST(Sun, StandsWhereTheReferenceAlgorithmSays) {
  // The worked example of Reda and Andreas 2004, "Solar position algorithm for solar radiation
  // applications", appendix A.5: zenith angle 50.11162, azimuth 194.34024. Their air is thinner
  // (820 hPa): refraction differs by less than 0.004 degrees.
  const SiteOrigin golden{39.742476, -105.1786, 1830.14};
  const Vec3 to_sun_W = ToSun(*ParseUtc("2003-10-17T19:30:30Z"), golden);
  EXPECT_NEAR(to_sun_W.norm(), 1, 1e-12);
  EXPECT_NEAR(90 - Height_deg(to_sun_W), 50.11162, 0.008);
  EXPECT_NEAR(Azimuth_deg(to_sun_W), 194.34024, 0.008);
}

TEST(Sun, IsOverheadOnTheTropicAtTheSolstice) {
  // 21 June 2024, true noon at 0 E is at 12:01:50 UTC; the sun's declination is 23.436 degrees.
  EXPECT_GT(Height_deg(ToSun(*ParseUtc("2024-06-21T12:01:50Z"), {23.436, 0, 0})), 89.9);
  EXPECT_LT(Height_deg(ToSun(*ParseUtc("2024-06-21T00:00:00Z"), {23.436, 0, 0})), -40);
}

TEST(Sun, HasNoLeapsBelowTheHorizon) {
  // Zurich, 10 December 2026, from before sunset on: it sinks 8 to 10 degrees an hour, every
  // minute.
  const SiteOrigin zurich{47.3763, 8.5477, 460};
  const TimeNs start_ns = *ParseUtc("2026-12-10T15:00:00Z");
  double before_deg = Height_deg(ToSun(start_ns, zurich));
  EXPECT_GT(before_deg, 3);
  for (int minute = 1; minute < 240; ++minute) {
    const double now_deg = Height_deg(ToSun(start_ns + minute * 60 * kNsPerSecond, zurich));
    ASSERT_LT(now_deg, before_deg) << minute;
    ASSERT_GT(now_deg, before_deg - 0.8) << minute;
    before_deg = now_deg;
  }
  EXPECT_LT(before_deg, -25);
}

TEST(Sun, LightFallsWithItsHeight) {
  // Worked by hand: 127.5 times 0.8106, and times 0.6570 at 30 degrees.
  EXPECT_NEAR(ClearSunIlluminance_klx(1), 103.35, 0.05);
  EXPECT_NEAR(ClearSunIlluminance_klx(0.5), 83.77, 0.05);
  EXPECT_EQ(ClearSunIlluminance_klx(0), 0);
  EXPECT_EQ(ClearSunIlluminance_klx(-0.3), 0);
}

TEST(Sky, IsAsBrightAsTheAlmanacSays) {
  // Ends of civil, nautical and astronomical twilight: 3.4, 0.008 and 0.0006 lx (Seidelmann 1992,
  // Explanatory Supplement to the Astronomical Almanac, table 9.22).
  EXPECT_NEAR(ClearSkyIlluminance_lx(-6 * kDeg), 3.4, 0.2);
  EXPECT_NEAR(ClearSkyIlluminance_lx(-12 * kDeg), 0.008, 0.001);
  EXPECT_NEAR(ClearSkyIlluminance_lx(-18 * kDeg), 0.0006, 0.0001);
  EXPECT_EQ(ClearSkyIlluminance_lx(-18 * kDeg), ClearSkyIlluminance_lx(-50 * kDeg));
  EXPECT_NEAR(ClearSkyIlluminance_lx(0), 759, 10);
  EXPECT_NEAR(ClearSkyIlluminance_lx(90 * kDeg), 16300, 1);
}

TEST(Exposure, IsThatOfALightMeter) {
  // ISO 2720 with C = 250: 2560 lx is 10 at ISO 100.
  EXPECT_NEAR(Ev100OfIlluminance(2.56), 10, 1e-12);
  EXPECT_NEAR(Ev100OfIlluminance(81.92), 15, 1e-12);
}

}  // namespace
}  // namespace tera
