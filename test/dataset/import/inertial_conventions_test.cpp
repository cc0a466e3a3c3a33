#include "dataset/import/inertial_conventions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/motion.h"
#include "core/units.h"

namespace tera {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kRate_hz = 50, kG_mps2 = 9.81;

/// A unit on a link whose pitch varies over time; its axes are forward, left and up at level.
std::vector<ImuSample> Pitched(double length_s, const std::function<double(double)>& pitch_rad) {
  std::vector<ImuSample> samples;
  for (int k = 0; k < length_s * kRate_hz; ++k) {
    const double t_s = k / kRate_hz, h_s = 1e-4;
    const Mat3 R_WS = RotationFromRpy(0, pitch_rad(t_s), 0.3);
    const double rate_radps = (pitch_rad(t_s + h_s) - pitch_rad(t_s - h_s)) / (2 * h_s);
    samples.push_back({FromSeconds(t_s), FromSeconds(t_s), Vec3(0, rate_radps, 0),
                       R_WS.transpose() * Vec3(0, 0, kG_mps2)});
  }
  return samples;
}

/// A boom that works between two angles, back and forth in 8 s.
std::vector<ImuSample> Boom(double from_deg, double to_deg) {
  return Pitched(40, [=](double t_s) {
    const double middle = 0.5 * (from_deg + to_deg), swing = 0.5 * (to_deg - from_deg);
    return (middle + swing * std::sin(2 * kPi * t_s / 8)) * kDeg;
  });
}

std::vector<ImuSample> Turned(std::vector<ImuSample> samples, const Mat3& R_FS) {
  for (ImuSample& one : samples) {
    one.w_WS_S_radps = R_FS * one.w_WS_S_radps;
    one.f_S_mps2 = R_FS * one.f_S_mps2;
  }
  return samples;
}

std::vector<InertialDoubt> DoubtsOf(const std::vector<ImuSample>& samples,
                                    const Vec3& up_S = Vec3::UnitZ()) {
  std::vector<InertialDoubt> doubts;
  for (const InertialFinding& one : JudgeInertial(
           samples.size(), [&](std::size_t k) { return samples[k]; }, up_S)) {
    doubts.push_back(one.doubt);
  }
  return doubts;
}

const Mat3 kForwardRightDown = RotationFromRpy(kPi, 0, 0);

TEST(InertialConventions, ALevelUnitWhoseZPointsDownIsToldAndOneThatHangsSoByItsMountIsNot) {
  const auto still = Pitched(2, [](double) { return 0.05; });
  EXPECT_THAT(DoubtsOf(still), IsEmpty());
  const auto down = Turned(still, kForwardRightDown);
  EXPECT_THAT(DoubtsOf(down), ElementsAre(InertialDoubt::kZDown));
  EXPECT_THAT(DoubtsOf(down, kForwardRightDown.transpose() * Vec3::UnitZ()), IsEmpty());
  // A unit on its side, stated by its mount: x up.
  const Mat3 on_its_side = RotationFromRpy(0, kPi / 2, 0);
  EXPECT_THAT(DoubtsOf(Turned(still, on_its_side), on_its_side * Vec3::UnitZ()), IsEmpty());
}

// A boom between -50 and 85 deg; an arm whose link turns from 20 to 150 deg from level as it digs,
// also parked at 150 deg; and a bucket over more than a turn. z points up, down and aside.
TEST(InertialConventions, UnitsOnLinksThatTiltAsTheyWorkAreNotTold) {
  EXPECT_THAT(DoubtsOf(Boom(-85, 50)), IsEmpty());
  EXPECT_THAT(DoubtsOf(Boom(20, 150)), IsEmpty());
  EXPECT_THAT(DoubtsOf(Pitched(10, [](double) { return 150 * kDeg; })), IsEmpty());
  EXPECT_THAT(DoubtsOf(Boom(0, 400)), IsEmpty());
}

TEST(InertialConventions, RatesInAnotherUnitAreToldByHowGravityTurnsInTheUnit) {
  const auto scaled = [](std::vector<ImuSample> samples, double by) {
    for (ImuSample& one : samples) one.w_WS_S_radps *= by;
    return samples;
  };
  // 40 deg in 4 s: numbers up to 16, within the speed of joints.
  EXPECT_THAT(DoubtsOf(scaled(Boom(-20, 20), 1 / kDeg)),
              ElementsAre(InertialDoubt::kRatesInDegrees));
  EXPECT_THAT(DoubtsOf(scaled(Boom(-20, 20), kDeg)), ElementsAre(InertialDoubt::kRatesInRadians));
  for (const double by : {1.0, 0.5, 2.0})
    EXPECT_THAT(DoubtsOf(scaled(Boom(-20, 20), by)), IsEmpty());
}

TEST(InertialConventions, RatesAboutTheVerticalAreToldByTheirSizeAlone) {
  auto slewing = Pitched(4, [](double) { return 0.0; });
  for (ImuSample& one : slewing) one.w_WS_S_radps = Vec3(0, 0, 0.5);
  EXPECT_THAT(DoubtsOf(slewing), IsEmpty());
  for (ImuSample& one : slewing) one.w_WS_S_radps = Vec3(0, 0, 0.5 / kDeg);
  EXPECT_THAT(DoubtsOf(slewing), ElementsAre(InertialDoubt::kRatesInDegrees));
}

// A level machine that accelerates and brakes by 2 m/s2 seems to tilt by 11.5 deg without turning.
TEST(InertialConventions, AccelerationsAreNoTurn) {
  auto driving = Pitched(60, [](double) { return 0.0; });
  for (ImuSample& one : driving) {
    const double phase = std::fmod(ToSeconds(one.t_ns), 8);
    one.f_S_mps2.x() = phase < 2 ? 2 : phase >= 4 && phase < 6 ? -2 : 0;
    one.w_WS_S_radps.z() = 0.2;
  }
  EXPECT_THAT(DoubtsOf(driving), IsEmpty());
}

TEST(InertialConventions, AnAccelerationWithoutGravityIsToldAndOneInGIsLeftToItsUnit) {
  auto still = Pitched(4, [](double) { return 0.1; });
  for (ImuSample& one : still) one.f_S_mps2 /= kG_mps2;
  EXPECT_THAT(DoubtsOf(still), IsEmpty());
  for (ImuSample& one : still) one.f_S_mps2 = Vec3(0.03, -0.02, 0.04);
  EXPECT_THAT(DoubtsOf(still), ElementsAre(InertialDoubt::kNoGravity));
}

}  // namespace
}  // namespace tera
