#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/units.h"
#include "sensors/gnss/gnss_slots.h"
#include "sensors/slots/given_effects.h"

namespace tera {
namespace {

using testing::ExpectNear, testing::Given;

const SiteFrame kSite(46.78, -71.27, 90);

GnssSample FixAt(const Vec3& enu_m, double t_s = 0) {
  const SiteFrame::Geodetic place = kSite.ToGeodetic(enu_m);
  return {FromSeconds(t_s), 0,     place.lat_deg,      place.lon_deg,
          place.height_m,   enu_m, GnssFix::kRtkFixed, Vec3(1e-4, 1e-4, 4e-4)};
}

GnssSample FixReported(const std::string& effects, const Vec3& enu_m, const RaisedBoom& boom = {}) {
  GnssSlots slots(Given(EffectTarget::kGnss, effects), 3, "m/gnss");
  GnssSample sample = FixAt(enu_m);
  slots.Apply(boom, kSite, &sample);
  return sample;
}

TEST(GnssErrors, AHeightOverTheGeoidLeavesThePlaceAlone) {
  const GnssSample plain = FixAt({3, 4, 5});
  const GnssSample sample = FixReported("{height_datum: {offset_m: 28.5}}", {3, 4, 5});
  EXPECT_NEAR(sample.alt_m - plain.alt_m, 28.5, 1e-6);
  EXPECT_NEAR(sample.lat_deg, plain.lat_deg, 1e-9);
  ExpectNear(sample.enu_m, {3, 4, 33.5}, 1e-12);
}

TEST(GnssErrors, AWrongDatumShiftsLatitudeAndLongitudeByItsMetres) {
  const GnssSample plain = FixAt({3, 4, 5});
  const GnssSample sample = FixReported("{position_datum: {east_m: 10, north_m: -20}}", {3, 4, 5});
  ExpectNear(sample.enu_m, {13, -16, 5}, 1e-12);
  // WGS 84 at 46.78 deg: a degree is 111.17 km north, 76.37 km east (curvature radii 6369.4 km and
  // 6389.5 km cos 46.78).
  EXPECT_NEAR((sample.lat_deg - plain.lat_deg) * 111'170, -20, 0.02);
  EXPECT_NEAR((sample.lon_deg - plain.lon_deg) * 76'370, 10, 0.02);
}

TEST(GnssErrors, AReceiversQuantisationIsThatOfItsSteps) {
  const GnssSample sample = FixReported(
      "{quantisation: {horizontal_step_m: 0.25, vertical_step_m: 0.1}}", {1.3, -2.9, 0.449});
  ExpectNear(sample.enu_m, {1.25, -3, 0.4}, 1e-12);
  ExpectNear(kSite.ToEnu({sample.lat_deg, sample.lon_deg, sample.alt_m}), {1.25, -3, 0.4}, 1e-7);
}

TEST(GnssErrors, OutliersOfAReceiverComeAsOftenAndAsLargeAsSaid) {
  GnssSlots slots(
      Given(EffectTarget::kGnss, "{outliers: {probability: 0.25, horizontal_m: 2, vertical_m: 6}}"),
      3, "m/gnss");
  const int n = 10000;
  int wild = 0;
  double east_squares = 0, up_squares = 0;
  for (int k = 0; k < n; ++k) {
    GnssSample sample = FixAt({1, 2, 3}, 0.1 * k);
    slots.Apply({}, kSite, &sample);
    const Vec3 error_m = sample.enu_m - Vec3(1, 2, 3);
    if (error_m.norm() == 0) continue;
    ++wild;
    east_squares += error_m.x() * error_m.x();
    up_squares += error_m.z() * error_m.z();
  }
  // Five standard errors: 5 sqrt(0.25 * 0.75 / 10000); 5 / sqrt(2 * 2500).
  EXPECT_NEAR(static_cast<double>(wild) / n, 0.25, 0.0217);
  EXPECT_NEAR(std::sqrt(east_squares / wild), 2, 2 * 0.0707);
  EXPECT_NEAR(std::sqrt(up_squares / wild), 6, 6 * 0.0707);
}

TEST(GnssErrors, MultipathTurnsWithTheBoomAndGrowsAsItRises) {
  const std::string effects = "{multipath: {horizontal_m: 0.04, vertical_m: 0.1, azimuth_deg: 20}}";
  const auto error = [&](double elevation_deg, double azimuth_deg) {
    const double e = elevation_deg * kDeg, a = azimuth_deg * kDeg;
    const Vec3 boom_W(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
    return Vec3(FixReported(effects, {1, 2, 3}, {boom_W}).enu_m - Vec3(1, 2, 3));
  };
  ExpectNear(error(30, 20), {0.02, 0, 0.05}, 1e-12);  // sin 30 = 1/2, at the maximum
  ExpectNear(error(30, 110), {0, 0.02, 0}, 1e-12);    // a quarter turn on
  ExpectNear(error(30, 200), {-0.02, 0, -0.05}, 1e-12);
  ExpectNear(error(89.9999, 20), {0.04, 0, 0.1}, 1e-7);
  ExpectNear(error(-10, 20), {0, 0, 0}, 1e-12);                     // lowered below the horizon
  EXPECT_EQ(FixReported(effects, {1, 2, 3}).enu_m, Vec3(1, 2, 3));  // nothing that reflects
}

TEST(GnssErrors, FloatSolutionsTakeTheirShareOfTimeAndSaySo) {
  GnssSlots slots(Given(EffectTarget::kGnss,
                        "{float_jump: {interval_s: 20, duration_s: 5, "
                        "horizontal_m: 0.3, vertical_m: 0.6}}"),
                  3, "m/gnss");
  const int n = 200000;
  int floating = 0, episodes = 0;
  double east_squares = 0, up_squares = 0;
  Vec3 last_m(0, 0, 0);
  for (int k = 0; k < n; ++k) {
    GnssSample sample = FixAt({1, 2, 3}, 0.1 * k);
    slots.Apply({}, kSite, &sample);
    const Vec3 error_m = sample.enu_m - Vec3(1, 2, 3);
    EXPECT_EQ(sample.fix == GnssFix::kRtkFloat, error_m.norm() > 0);
    if (error_m.norm() > 0) {
      ++floating;
      EXPECT_NEAR(sample.variance_enu_m2.x(), 0.0901, 1e-12);
      if (last_m.norm() == 0) {
        ++episodes;
        east_squares += error_m.x() * error_m.x();
        up_squares += error_m.z() * error_m.z();
      } else {
        ExpectNear(error_m, last_m, 1e-12);  // one place for the whole episode
      }
    }
    last_m = error_m;
  }
  // Share 5 / 25 over 20 000 s with a correlation time of 1 / (1/20 + 1/5) = 4 s: standard error
  // sqrt(0.2 * 0.8 * 2 * 4 / 20000) = 0.008. About 800 episodes: 5 / sqrt(2 * 800) = 12.5 %.
  EXPECT_NEAR(static_cast<double>(floating) / n, 0.2, 0.04);
  EXPECT_NEAR(std::sqrt(east_squares / episodes), 0.3, 0.3 * 0.125);
  EXPECT_NEAR(std::sqrt(up_squares / episodes), 0.6, 0.6 * 0.125);
}

TEST(GnssErrors, AReceiverWithoutCarrierPhaseHasNoFixedSolutionToLose) {
  GnssSlots slots(Given(EffectTarget::kGnss, "{float_jump: {interval_s: 0.1}}"), 3, "m/gnss");
  for (int k = 0; k < 50; ++k) {
    GnssSample sample = FixAt({1, 2, 3}, 0.1 * k);
    sample.fix = GnssFix::kSingle;
    slots.Apply({}, kSite, &sample);
    EXPECT_EQ(sample.fix, GnssFix::kSingle);
    EXPECT_EQ(sample.enu_m, Vec3(1, 2, 3));
  }
}

TEST(GnssErrors, AReceiverWithoutAFixHasNothingToSpoil) {
  GnssSlots slots(Given(EffectTarget::kGnss,
                        "{position_datum: {east_m: 10}, float_jump: {interval_s: 0.1}, "
                        "filter_delay: {time_constant_s: 1}}"),
                  3, "m/gnss");
  for (int k = 0; k < 20; ++k) {
    GnssSample sample;
    sample.t_ns = TimeNs{k} * 100'000'000;
    slots.Apply({}, kSite, &sample);
    EXPECT_EQ(sample.fix, GnssFix::kNone);
    EXPECT_EQ(sample.enu_m, Vec3::Zero());
    EXPECT_EQ(sample.lat_deg, 0);
  }
}

}  // namespace
}  // namespace tera
