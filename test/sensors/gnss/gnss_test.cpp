#include "sensors/gnss/gnss.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

namespace tera {
namespace {

/// Output of GeographicLib's own command-line program for one point.
std::array<double, 3> CartConvert(const std::string& options, const std::string& input) {
  const std::string command = "echo " + input + " | CartConvert " + options;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::array<double, 3> out{};
  EXPECT_EQ(std::fscanf(pipe.get(), "%lf %lf %lf", &out[0], &out[1], &out[2]), 3) << command;
  return out;
}

TEST(SiteFrame, AgreesWithCartConvert) {
  const SiteFrame site(42.9995, -78.7886, 182.5);
  for (const Vec3& p : {Vec3(12.25, -33.5, 4.75), Vec3(-1500, 2300, -20), Vec3(0, 0, 0)}) {
    const auto expected = CartConvert("-l 42.9995 -78.7886 182.5 -r -p 9",
                                      fmt::format("{} {} {}", p.x(), p.y(), p.z()));
    const SiteFrame::Geodetic place = site.ToGeodetic(p);
    EXPECT_NEAR(place.lat_deg, expected[0], 1e-9);
    EXPECT_NEAR(place.lon_deg, expected[1], 1e-9);
    EXPECT_NEAR(place.height_m, expected[2], 1e-4);
    EXPECT_NEAR((site.ToEnu(place) - p).norm(), 0, 1e-8);
  }
}

std::vector<GnssSample> Standing(const GnssModel& model, int count, double rate_hz,
                                 const Vec3& p_WS_m = {4, 5, 6}) {
  const SiteFrame site(42.9995, -78.7886, 182.5);
  Gnss gnss(model, {.rate_hz = rate_hz}, 50'000'000, 11, "m/gnss");
  std::vector<GnssSample> samples;
  for (int k = 0; k < count; ++k) samples.push_back(gnss.Measure(k, p_WS_m, site));
  return samples;
}

TEST(Gnss, WithoutErrorsItReportsTheAntenna) {
  const GnssSample s = Standing({}, 3, 10).back();
  EXPECT_EQ(s.t_ns, 200'000'000);
  EXPECT_EQ(s.t_available_ns, 250'000'000);
  EXPECT_EQ(s.enu_m, Vec3(4, 5, 6));
  EXPECT_EQ(s.fix, GnssFix::kRtkFixed);
  EXPECT_EQ(s.variance_enu_m2, Vec3::Zero());
  const auto expected = CartConvert("-l 42.9995 -78.7886 182.5 -r -p 9", "4 5 6");
  EXPECT_NEAR(s.lat_deg, expected[0], 1e-9);
  EXPECT_NEAR(s.lon_deg, expected[1], 1e-9);
  EXPECT_NEAR(s.alt_m, expected[2], 1e-4);
}

TEST(Gnss, WhiteErrorHasItsDeviationAndReportsIt) {
  // n = 10000: standard error of a variance sigma^2 sqrt(2 / n) = 1.4 %, five of them 7 %.
  GnssModel model;
  model.white_horizontal_m = 0.3;
  model.white_vertical_m = 0.5;
  Vec3 squares = Vec3::Zero();
  const auto samples = Standing(model, 10000, 10);
  for (const GnssSample& s : samples) squares += (s.enu_m - Vec3(4, 5, 6)).cwiseAbs2() / 10000;
  EXPECT_NEAR(squares.x(), 0.09, 0.07 * 0.09);
  EXPECT_NEAR(squares.y(), 0.09, 0.07 * 0.09);
  EXPECT_NEAR(squares.z(), 0.25, 0.07 * 0.25);
  EXPECT_NEAR((samples[0].variance_enu_m2 - Vec3(0.09, 0.09, 0.25)).norm(), 0, 1e-12);
}

TEST(Gnss, CorrelatedErrorIsStationaryAndForgetsWithItsTimeConstant) {
  // tau = 2 s at 10 Hz. n = 200000 samples hold about n (1 - a^2) / (1 + a^2) = 9995 independent
  // values of x^2 (a = e^-0.05). Five standard errors of the variance are 5 sqrt(2 / 9995) = 7 %;
  // of a correlation (Bartlett) less than 5 sqrt(2 / 9995) = 0.07.
  GnssModel model;
  model.correlated_horizontal_m = 0.5;
  model.correlated_vertical_m = 0.8;
  model.correlation_time_s = 2;
  const auto samples = Standing(model, 200000, 10);
  const auto moment = [&](std::size_t lag, int axis) {
    double sum = 0;
    for (std::size_t k = lag; k < samples.size(); ++k) {
      sum += (samples[k].enu_m[axis] - (4 + axis)) * (samples[k - lag].enu_m[axis] - (4 + axis));
    }
    return sum / static_cast<double>(samples.size() - lag);
  };
  EXPECT_NEAR(moment(0, 0), 0.25, 0.07 * 0.25);
  EXPECT_NEAR(moment(0, 1), 0.25, 0.07 * 0.25);
  EXPECT_NEAR(moment(0, 2), 0.64, 0.07 * 0.64);
  EXPECT_NEAR(moment(20, 0) / moment(0, 0), std::exp(-1.0), 0.07);
  EXPECT_NEAR(moment(40, 2) / moment(0, 2), std::exp(-2.0), 0.07);
}

TEST(Gnss, CorrelatedErrorStartsWithItsFullDeviation) {
  // 400 receivers, first sample: five standard errors of the variance are 5 sqrt(2/400) = 35 %.
  GnssModel model;
  model.correlated_horizontal_m = 0.5;
  const SiteFrame site(42, -78, 180);
  double variance = 0;
  for (int seed = 0; seed < 400; ++seed) {
    Gnss gnss(model, {.rate_hz = 10}, 0, seed, "m/gnss");
    variance += std::pow(gnss.Measure(0, Vec3(1, 2, 3), site).enu_m.x() - 1, 2) / 400;
  }
  EXPECT_NEAR(variance, 0.25, 0.35 * 0.25);
}

TEST(Gnss, AConstantBiasShiftsThePositionOnly) {
  GnssModel model;
  model.bias_enu_m = Vec3(0.75, -0.5, 2);
  const GnssSample s = Standing(model, 1, 10)[0];
  EXPECT_NEAR((s.enu_m - Vec3(4.75, 4.5, 8)).norm(), 0, 1e-12);
  EXPECT_EQ(s.variance_enu_m2, Vec3::Zero());
}

TEST(Gnss, WithoutAFixThereIsNoPosition) {
  GnssModel model;
  model.fix = GnssFix::kNone;
  const GnssSample s = Standing(model, 1, 10)[0];
  EXPECT_EQ(s.fix, GnssFix::kNone);
  EXPECT_EQ(s.lat_deg, 0);
  EXPECT_EQ(s.enu_m, Vec3::Zero());
}

}  // namespace
}  // namespace tera
