#include "dataset/import/angle_wrap.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/import_csv.h"

namespace tera {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Numbers of a single-turn sensor for an angle that grows by `step` per row.
std::vector<double> Turning(double first, double step, int rows, double turn, double lowest = 0) {
  std::vector<double> shown;
  for (int k = 0; k < rows; ++k) {
    const double angle = first + step * k - lowest;
    shown.push_back(angle - turn * std::floor(angle / turn) + lowest);
  }
  return shown;
}

TEST(AngleWrap, AJumpIsWhereASensorBeginsAnewWhateverTheRateAndTheUnit) {
  // 6 deg a row from 354 on: 354, 0; 120 deg a row: 0, 120, 240, 0.
  EXPECT_THAT(JumpsOf(Turning(342, 6, 5, 360), 360), ElementsAre(3));
  EXPECT_THAT(JumpsOf(Turning(0, 120, 5, 360), 360), ElementsAre(3));
  EXPECT_THAT(JumpsOf(Turning(170, 5, 4, 360, -180), 360), ElementsAre(2));
  EXPECT_THAT(JumpsOf(Turning(4090, 3, 4, 4096), 4096), ElementsAre(2));
  EXPECT_THAT(JumpsOf(Turning(0.1, -0.1, 3, 2 * kPi), 2 * kPi), ElementsAre(2));
  for (const double step : {6.0, 120.0, -50.0}) {
    EXPECT_TRUE(BeginsAnew(Turning(342, step, 12, 360), 360)) << step;
  }
}

TEST(AngleWrap, WhatGoesOnFastOrFoldsBackIsNoJump) {
  EXPECT_THAT(JumpsOf({0, 5, 10, 15, 20}, 2 * kPi), IsEmpty());        // a wheel of 5 rad a row
  EXPECT_THAT(JumpsOf({10, 40, 70, 90, 70, 40}, 2 * kPi), IsEmpty());  // degrees taken for radians
  EXPECT_THAT(JumpsOf({85, 89, 87, 80}, 360), IsEmpty());              // an inclinometer beyond 90
  // A step of exactly half a turn, as from -90 to 90, has no direction.
  EXPECT_THAT(JumpsOf({80, 88, -88, -80}, 360), IsEmpty());
}

TEST(AngleWrap, ASingleWrongValueIsNoSensorThatBeginsAnew) {
  const std::vector<double> angle = {10, 11, 12, 250, 13, 14};
  EXPECT_THAT(JumpsOf(angle, 360), ElementsAre(3, 4));
  EXPECT_FALSE(BeginsAnew(angle, 360));
}

TEST(AngleWrap, UnwrappedAnglesGoOnOverSeveralTurnsBothWays) {
  for (const double step : {50.0, -50.0}) {
    std::vector<double> angle = Turning(300, step, 20, 360);
    EXPECT_GT(Unwrap(360, &angle), 1u);
    for (std::size_t k = 1; k < angle.size(); ++k) {
      EXPECT_NEAR(angle[k] - angle[k - 1], step, 1e-9) << k;
    }
    EXPECT_EQ(angle.front(), 300);
  }
}

/// A log of a slew that turns by 12 deg/s and shows 0 to 360 deg, and its import.
class WrappedSlew : public testing::Test {
 protected:
  /// `rows` of `rate_hz` from `first_deg` on, in `per_deg` of the file's unit.
  void Log(double rate_hz, double first_deg, int rows, double per_deg = 1) const {
    std::string text = "t,slew\n";
    for (int k = 0; k < rows; ++k) {
      text += fmt::format("{},{:.6f}\n", k / rate_hz,
                          per_deg * std::fmod(first_deg + 12 * k / rate_hz, 360));
    }
    WriteWholeFile(scratch_.path() / "log.csv", text);
  }
  ImportReport Import(const std::string& joint) const {
    WriteWholeFile(scratch_.path() / "mapping.yaml",
                   "name: slew\nmachine: digger\nfile: log.csv\ntime: {column: t, unit: s}\n"
                   "encoders: [{name: joints, joints: [" +
                       joint + "]}]\n");
    std::filesystem::remove_all(scratch_.path() / "out");
    return ImportCsv(scratch_.path() / "mapping.yaml", scratch_.path() / "out");
  }
  std::vector<EncoderSample> Samples() const {
    return Recording(scratch_.path() / "out").LoadEncoder("digger/joints").samples;
  }

  ScratchDirectory scratch_;
};

TEST_F(WrappedSlew, GoesOnAtTheSameRateWhereTheMappingSaysThatItBeginsAnew) {
  for (const double rate_hz : {2.0, 50.0}) {
    Log(rate_hz, 348, 41);
    const ImportReport report =
        Import("{name: slew, angle: {column: slew, unit: deg}, wrap_deg: 360}");
    EXPECT_THAT(report.channels[0].remarks,
                ElementsAre(HasSubstr("its column wraps after 360 deg, ")));
    for (const EncoderSample& one : Samples()) EXPECT_NEAR(one.qd_radps[0], 0.2094395, 1e-4);
    EXPECT_NEAR(Samples().back().q_rad[0], (348 + 12 * 40 / rate_hz) * kDeg, 1e-6);
  }
}

TEST_F(WrappedSlew, TurnsInCountsAndRadiansAsWell) {
  Log(2, 348, 41, 4096.0 / 360);
  Import("{name: slew, angle: {column: slew, unit: deg, scale: 0.087890625}, wrap_deg: 360}");
  for (const EncoderSample& one : Samples()) EXPECT_NEAR(one.qd_radps[0], 0.2094395, 1e-4);
  Log(2, 348, 41, kDeg);
  Import("{name: slew, angle: {column: slew, unit: rad}, wrap_deg: 360}");
  for (const EncoderSample& one : Samples()) EXPECT_NEAR(one.qd_radps[0], 0.2094395, 1e-4);
}

TEST_F(WrappedSlew, IsToldAsAJumpAtAnyRateAndNotAsDegrees) {
  for (const double rate_hz : {2.0, 50.0}) {
    Log(rate_hz, 348, 101);
    const ImportReport report = Import("{name: slew, angle: {column: slew, unit: deg}}");
    ASSERT_EQ(report.channels[0].remarks.size(), 1u) << rate_hz;
    EXPECT_THAT(report.channels[0].remarks[0],
                testing::AllOf(HasSubstr(" of slew by more than half a turn, the first at "),
                               HasSubstr("wrap_deg: 360")));
    EXPECT_EQ(report.channels[0].too_fast, 0);
  }
}

TEST_F(WrappedSlew, AJointThatSlidesOrHasNoAngleBeginsNowhereAnew) {
  Log(2, 0, 4);
  for (const char* joint : {"{name: stick, travel: {column: slew, unit: mm}, wrap_deg: 360}",
                            "{name: slew, rate: {column: slew, unit: deg/s}, wrap_deg: 360}"}) {
    EXPECT_THAT([&] { Import(joint); },
                testing::ThrowsMessage<InputError>(
                    HasSubstr("wrap_deg: belongs to a joint that already has an angle; remove it")))
        << joint;
  }
}

}  // namespace
}  // namespace tera
