#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/units.h"
#include "sensors/imu/imu_slots.h"
#include "sensors/slots/given_effects.h"

namespace tera {
namespace {

using testing::ExpectNear, testing::Given;

constexpr double kG_mps2 = 9.80665;

ImuSlots ImuWith(const std::string& effects) {
  return ImuSlots(Given(EffectTarget::kImu, effects), 3, "m/imu");
}

ImuSample Reported(ImuSlots slots, const Vec3& w_degps, const Vec3& f_mps2, double t_s = 0) {
  ImuSample sample{FromSeconds(t_s), 0, w_degps * kDeg, f_mps2};
  slots.Apply(&sample);
  sample.w_WS_S_radps /= kDeg;
  return sample;
}

TEST(ImuErrors, AnImusScaleComesBeforeItsBias) {
  const ImuSample sample = Reported(
      ImuWith("{scale: {gyro_z_factor: 1.1, accel_x_factor: 0.5}, "
              "bias: {gyro_z_degps: 0.5, gyro_x_degps: -2, accel_x_mps2: 0.25, accel_z_mps2: 1}}"),
      {1, 2, 10}, {4, 5, 6});
  ExpectNear(sample.w_WS_S_radps, {-1, 2, 11.5}, 1e-9);
  ExpectNear(sample.f_S_mps2, {2.25, 5, 7}, 1e-12);
}

TEST(ImuErrors, AnImuSaturatesAtItsLimitsOnBothSides) {
  const ImuSlots slots = ImuWith("{saturation: {gyro_limit_degps: 250, accel_limit_mps2: 20}}");
  const ImuSample sample = Reported(slots, {249, -300, 1000}, {-25, 19.5, 21});
  ExpectNear(sample.w_WS_S_radps, {249, -250, 250}, 1e-9);
  ExpectNear(sample.f_S_mps2, {-20, 19.5, 20}, 1e-12);
  // Default: a chip of 2000 deg/s and 16 g.
  const ImuSample usual = Reported(ImuWith("{saturation: {}}"), {2500, 0, 0}, {0, 0, 500});
  EXPECT_NEAR(usual.w_WS_S_radps.x(), 2000, 1e-9);
  EXPECT_NEAR(usual.f_S_mps2.z(), 16 * kG_mps2, 1e-9);
}

TEST(ImuErrors, AnImuSaturatesBehindItsBiasAndRoundsAfterwards) {
  const ImuSample sample =
      Reported(ImuWith("{bias: {accel_z_mps2: 3}, saturation: {accel_limit_mps2: 10.2}, "
                       "quantisation: {accel_step_mps2: 0.5, gyro_step_degps: 0.25}}"),
               {0.1, 0.13, -0.4}, {0.2, -0.3, 9});
  ExpectNear(sample.f_S_mps2, {0, -0.5, 10}, 1e-12);
  ExpectNear(sample.w_WS_S_radps, {0, 0.25, -0.5}, 1e-9);
}

TEST(ImuErrors, OutliersOfAnImuComeAsOftenAndAsLargeAsSaid) {
  ImuSlots slots = ImuWith("{outliers: {probability: 0.1, gyro_degps: 40, accel_mps2: 5}}");
  const int n = 20000;
  int wild = 0;
  double gyro_squares = 0, accel_squares = 0;
  for (int k = 0; k < n; ++k) {
    ImuSample sample{TimeNs{k} * 10'000'000, 0, Vec3(1, 0, 0), Vec3(0, 0, 9)};
    slots.Apply(&sample);
    const Vec3 w_degps = (sample.w_WS_S_radps - Vec3(1, 0, 0)) / kDeg;
    if (w_degps.norm() == 0) continue;
    ++wild;
    gyro_squares += w_degps.squaredNorm() / 3;
    accel_squares += (sample.f_S_mps2 - Vec3(0, 0, 9)).squaredNorm() / 3;
  }
  // Standard error of a share: sqrt(0.1 * 0.9 / 20000) = 0.0021; five of them.
  EXPECT_NEAR(static_cast<double>(wild) / n, 0.1, 0.0106);
  // Five standard errors of an rms over 3 * 2000 draws, each 1 / sqrt(2 * 6000) = 0.9 %.
  EXPECT_NEAR(std::sqrt(gyro_squares / wild), 40, 40 * 0.046);
  EXPECT_NEAR(std::sqrt(accel_squares / wild), 5, 5 * 0.046);
}

TEST(ImuErrors, AnImuThatWarmsUpDriftsAtFirstBySlopeAndThenSettles) {
  const ImuSlots slots = ImuWith(
      "{temperature_drift: {warm_up_k: 30, time_constant_s: 600, gyro_x_degpspk: 0.02, "
      "accel_z_mps2pk: -0.01}}");
  const auto at = [&](double t_s) { return Reported(slots, {0, 0, 0}, {0, 0, 9}, t_s); };
  EXPECT_EQ(at(0).w_WS_S_radps.x(), 0);
  // 30 K in 600 s are 0.05 K/s at first: 0.001 deg/s every second.
  EXPECT_NEAR(at(1).w_WS_S_radps.x(), 0.001, 1e-6);
  EXPECT_NEAR(at(600).w_WS_S_radps.x(), 0.6 * 0.6321206, 1e-6);
  EXPECT_NEAR(at(60000).w_WS_S_radps.x(), 0.6, 1e-9);
  EXPECT_NEAR(at(60000).f_S_mps2.z(), 8.7, 1e-9);
}

TEST(ImuErrors, AVibratingAccelerometerShiftsByTheVarianceOfWhatItFeels) {
  ImuSlots slots = ImuWith(
      "{vibration_rectification: {z_s2pm: 0.01, x_s2pm: -0.002, engine_rms_mps2: 3, window_s: 5}}");
  Vec3 shift = Vec3::Zero();
  for (int k = 0; k < 60000; ++k) {
    // 4 m/s^2 at 50 Hz: a variance of 8 m^2/s^4, plus the engine's 9.
    const Vec3 f_mps2(0, 0, 9 + 4 * std::sin(2 * kPi * 50 * 0.001 * k));
    ImuSample sample{TimeNs{k} * 1'000'000, 0, Vec3::Zero(), f_mps2};
    slots.Apply(&sample);
    shift = sample.f_S_mps2 - f_mps2;
    if (k == 0) {
      EXPECT_NEAR(shift.z(), 0.09, 1e-12);
    }
  }
  EXPECT_NEAR(shift.z(), 0.17, 0.002);
  EXPECT_NEAR(shift.x(), -0.034, 0.0004);
}

}  // namespace
}  // namespace tera
