#include "blind/mujoco/sensors/readings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "blind/mujoco/plant/model.h"
#include "blind/mujoco/sensors/bracket.h"

namespace tera::blind::mujoco {
namespace {

constexpr double kGravity_mps2 = 9.8071;

/// Readings of a unit on a link whose slope changes from 0.3 rad at 0.5 rad/s after a second.
std::array<double, 6> OnLink(double t_s) {
  const double turning_s = std::max(0.0, t_s - 1), up_rad = 0.3 + 0.5 * turning_s;
  return {0, turning_s > 0 ? -0.5 : 0,        0, kGravity_mps2 * std::sin(up_rad),
          0, kGravity_mps2 * std::cos(up_rad)};
}

TEST(Bracket, BendsByTheWeightAlongItsNormal) {
  Bracket bracket({0.05, false}, {0, 0, 0});
  std::array<double, 6> felt{};
  for (int k = 0; k < 900; ++k) felt = bracket.Felt(OnLink(0), 0.001);
  // Rotated about y by b: the link's slope is smaller by b there.
  const double bent_rad = 0.05 * std::cos(0.3);
  EXPECT_NEAR(felt[3], kGravity_mps2 * std::sin(0.3 - bent_rad), 1e-6);
  EXPECT_NEAR(felt[5], kGravity_mps2 * std::cos(0.3 - bent_rad), 1e-6);
  EXPECT_NEAR(felt[1], 0, 1e-6);
}

TEST(Bracket, GyrosFeelTheBendingToo) {
  Bracket bracket({0.05, false}, {0, 0, kGravity_mps2 * std::cos(0.3)});
  double turned_rad = 0;
  for (int k = 0; k < 3000; ++k) turned_rad += 0.001 * bracket.Felt(OnLink(0.001 * k), 0.001)[1];
  // From 0.3 to 1.3 rad, which is about -y; the plate springs back, 0.03 s late.
  EXPECT_NEAR(turned_rad, -1 + 0.05 * (std::cos(1.3) - std::cos(0.3)), 0.002);
}

TEST(Clock, DriftsAndIsSet) {
  const ClockForm drifts{.offset_s = 0.02, .drift = 0.002}, set{.offset_s = 0.3, .set_s = 12};
  EXPECT_NEAR(drifts.OffsetAt(50), 0.02 + 0.1, 1e-12);
  EXPECT_EQ(set.OffsetAt(11.9), 0);
  EXPECT_EQ(set.OffsetAt(12.1), 0.3);
}

/// A course with a joint that turns from -2 rad at 0.5 rad/s, and a base that looks north.
Course Turning(std::size_t axis) {
  Course course;
  for (int k = 0; k <= 4000; ++k) {
    Instant at;
    at.p_WB_m = Vec3::Zero();
    at.q_WB = Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()));
    for (std::size_t u = 0; u < kUnits; ++u) {
      at.gyro_radps[u] = Vec3::Zero();
      at.accelerometer_mps2[u] = {0, 0, kGravity_mps2};
    }
    for (Vec3& antenna : at.antenna_m) antenna = {3, 4, 5};
    at.angle_rad[axis] = -2 + 0.5 * kStep_s * k;
    at.rate_radps[axis] = 0.5;
    course.instants.push_back(at);
  }
  return course;
}

MachineNumbers Plain() {
  MachineNumbers numbers;
  numbers.joints[kBoom].axis = {0, -1, 0};
  numbers.joints[kArm].pin_m = {2, 0, 0};
  return numbers;
}

/// Rates are the derivatives of angles.
void ExpectRateOfAngle(const Readings& readings, double t_s) {
  const double change = readings.Angle_rad(kArm, t_s + 0.01) - readings.Angle_rad(kArm, t_s - 0.01);
  EXPECT_NEAR(readings.Rate_radps(kArm, t_s), change / 0.02, 1e-6);
}

TEST(Readings, ARingOffItsCentreErrsMostWhereItIsSaid) {
  const MachineNumbers numbers = Plain();
  const Course course = Turning(kArm);
  SensorsForm form;
  form.encoders[kArm].ring_rad = 0.02;
  form.encoders[kArm].ring_at_rad = -1;
  const Readings readings(numbers, course, form);
  EXPECT_NEAR(readings.Angle_rad(kArm, 2), -1 + 0.02, 1e-12);
  EXPECT_NEAR(readings.Angle_rad(kArm, 4), 0 + 0.02 * std::cos(1), 1e-12);
  for (const double t_s : {0.5, 2.0, 3.5}) ExpectRateOfAngle(readings, t_s);
}

TEST(Readings, ADrumWithMoreCordOnItCountsLess) {
  const MachineNumbers numbers = Plain();
  const Course course = Turning(kArm);
  SensorsForm form;
  EncoderForm& drum = form.encoders[kArm];
  drum.angle_factor = drum.rate_factor = 1.08;
  drum.zero_rad = 0.08;  // right at -1 rad
  drum.wound_1prad = 0.02;
  drum.wound_from_rad = -1;
  const Readings readings(numbers, course, form);
  EXPECT_NEAR(readings.Angle_rad(kArm, 2), -1, 1e-12);
  EXPECT_NEAR(readings.Rate_radps(kArm, 2) / 0.5, 1.08, 1e-12);
  EXPECT_NEAR(readings.Rate_radps(kArm, 4) / 0.5, 1.10, 1e-12);
  for (const double t_s : {0.5, 2.0, 3.5}) ExpectRateOfAngle(readings, t_s);
}

TEST(Readings, ABiasComesWithAKnock) {
  const MachineNumbers numbers = Plain();
  const Course course = Turning(kArm);
  SensorsForm form;
  form.units[1].gyro_radps = {0, 0.02, 0};
  form.units[1].knocked_s = 2;
  const Readings readings(numbers, course, form);
  EXPECT_NEAR(readings.Unit(1, 1.99)[1], 0, 1e-9);
  EXPECT_NEAR(readings.Unit(1, 2.01)[1], 0.02, 1e-9);
}

TEST(Readings, ARaisedBoomThatShadesPushesAwayAndDown) {
  const MachineNumbers numbers = Plain();
  const Course course = Turning(kBoom);
  SensorsForm form;
  form.receivers[0].shaded_m = 0.3;
  const Readings readings(numbers, course, form);
  const Vec3 level_m = readings.Receiver_m(0, 4) - Vec3(3, 4, 5);
  // Boom level, nose north: half a metre counts as raised, which leaves 0.5 / 1.1.
  EXPECT_NEAR(level_m.x(), 0, 1e-9);
  EXPECT_NEAR(level_m.y(), -0.3 * 0.5 / 1.1, 1e-9);
  EXPECT_NEAR(level_m.z(), -0.15 * 0.5 / 1.1, 1e-9);
  EXPECT_NEAR((readings.Receiver_m(0, 0) - Vec3(3, 4, 5)).norm(), 0, 1e-9);  // hangs down
}

TEST(Readings, TrucksPullAsTheyPass) {
  const MachineNumbers numbers = Plain();
  const Course course = Turning(kBoom);
  SensorsForm form;
  form.receivers[1].truck = {.pull_m = 0.2, .first_s = 1, .every_s = 25, .towards_rad = M_PI / 2};
  const Readings readings(numbers, course, form);
  const auto pulled_m = [&](double t_s) -> Vec3 {
    return readings.Receiver_m(1, t_s) - Vec3(3, 4, 5);
  };
  EXPECT_NEAR(pulled_m(1).y(), 0.2, 1e-9);
  EXPECT_NEAR(pulled_m(3).y(), 0.2 / M_E, 1e-9);
  EXPECT_NEAR(pulled_m(26).y(), 0.2, 1e-9);
  EXPECT_LT(pulled_m(13).norm(), 1e-9);
}

}  // namespace
}  // namespace tera::blind::mujoco
