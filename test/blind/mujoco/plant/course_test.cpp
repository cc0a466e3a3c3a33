#include "blind/mujoco/plant/course.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "blind/mujoco/plant/model.h"
#include "blind/mujoco/plant/some_course.h"

namespace tera::blind::mujoco {
namespace {

constexpr double kGravity_mps2 = 9.807;  ///< at 47 deg north (Somigliana)

/// One lever at a level from 0.5 s on, for `length_s`.
Operator Pushes(std::size_t axis, double level, double length_s) {
  return [=](double t_s, const Instant&) {
    PerAxis<double> levers{};
    if (t_s >= 0.5 && t_s < 0.5 + length_s) levers[axis] = level;
    return levers;
  };
}

const Operator kRests = [](double, const Instant&) { return PerAxis<double>{}; };

/// Integral of a column of instants, by the trapezoidal rule.
template <typename Value>
double Integral(const Course& course, const Value& value) {
  double sum = 0;
  for (std::size_t k = 1; k < course.instants.size(); ++k) {
    sum += kStep_s * (value(course.instants[k]) + value(course.instants[k - 1])) / 2;
  }
  return sum;
}

TEST(MujocoCourse, AUnitAtRestReadsGravityAgainstItsFall) {
  const Instant rest = DriveBy(kRests, 1).At(1);
  // The chassis is level; the boom's x points 0.35 rad up, the arm's 0.35 - 1.4 rad. The machine's
  // sinkage at one end is less than 2 mrad.
  const double up[] = {0, 0.35, 0.35 - 1.4, 0.35 - 1.4 - 0.3};
  for (std::size_t u = 0; u < kUnits; ++u) {
    EXPECT_NEAR(rest.accelerometer_mps2[u].x(), kGravity_mps2 * std::sin(up[u]), 0.03) << u;
    EXPECT_NEAR(rest.accelerometer_mps2[u].y(), 0, 0.03) << u;
    EXPECT_NEAR(rest.accelerometer_mps2[u].z(), kGravity_mps2 * std::cos(up[u]), 0.03) << u;
    EXPECT_LT(rest.gyro_radps[u].norm(), 1e-3) << u;
  }
}

TEST(MujocoCourse, GyrosIntegrateToWhatTheEncodersTurn) {
  const Course course = DriveBy(
      [](double t_s, const Instant&) {
        PerAxis<double> levers{};
        if (t_s > 0.5 && t_s < 1.5) levers[kBoom] = 0.4, levers[kArm] = -0.5;
        return levers;
      },
      2.5);
  const Instant &first = course.instants.front(), &last = course.instants.back();
  const double boom_rad = last.angle_rad[kBoom] - first.angle_rad[kBoom];
  const double arm_rad = last.angle_rad[kArm] - first.angle_rad[kArm];
  EXPECT_GT(boom_rad, 0.1);
  EXPECT_LT(arm_rad, -0.2);
  // Joints turn links upwards, which is about -y. The chassis rocks on its ground by some mrad.
  EXPECT_NEAR(Integral(course, [](const Instant& at) { return at.gyro_radps[1].y(); }), -boom_rad,
              0.004);
  EXPECT_NEAR(Integral(course, [](const Instant& at) { return at.gyro_radps[2].y(); }),
              -(boom_rad + arm_rad), 0.004);
}

TEST(MujocoCourse, AntennasAreAsFarApartAsTheyAreMounted) {
  PlantForm form;
  form.antennas[0].xyz_m = {0, 0.2, 0};
  const Course as_documented = DriveBy(kRests, 0.1), displaced = DriveBy(kRests, 0.1, form);
  const auto apart = [](const Course& course) {
    const Instant& at = course.instants.back();
    return (at.antenna_m[0] - at.antenna_m[1]).norm();
  };
  EXPECT_NEAR(apart(as_documented), 1, 1e-9);
  EXPECT_NEAR(apart(displaced), 1.2, 1e-9);
}

TEST(MujocoCourse, AMachineStandsStillOnASlopeAndLiesOnIt) {
  Start start = SomeStart();
  start.ground.slope = {0.06, -0.04};
  const Course course = DriveBy(kRests, 6, {}, start);
  const Instant &first = course.At(0), &last = course.At(6);
  EXPECT_LT((last.p_WB_m - first.p_WB_m).norm(), 1e-3);
  const Vec3 up = last.q_WB * Vec3::UnitZ();
  EXPECT_NEAR(up.x() / up.z(), -0.06, 0.002);
  EXPECT_NEAR(up.y() / up.z(), 0.04, 0.002);
}

TEST(MujocoCourse, TracksGoAsFarAsTheirSprocketsTurn) {
  const Operator ahead = [](double t_s, const Instant&) {
    PerAxis<double> levers{};
    if (t_s < 4) levers[kLeftTrack] = levers[kRightTrack] = 0.5;
    return levers;
  };
  const Instant last = DriveBy(ahead, 5).At(5);
  const double way_m = 0.225 * last.angle_rad[kLeftTrack];
  EXPECT_NEAR(way_m, 0.5 * 1.25 * 4, 0.03);
  EXPECT_NEAR(last.p_WB_m.x(), way_m * std::cos(0.7), 0.01 * way_m);
  EXPECT_NEAR(last.p_WB_m.y(), way_m * std::sin(0.7), 0.01 * way_m);
}

TEST(MujocoCourse, ATurnOnTheSpotIsThatOfTheGauge) {
  const Operator turn = [](double t_s, const Instant&) {
    PerAxis<double> levers{};
    const double level = 0.3 * std::clamp(std::min(t_s, 4 - t_s), 0.0, 1.0);
    levers[kLeftTrack] = -level, levers[kRightTrack] = level;
    return levers;
  };
  const Instant last = DriveBy(turn, 5).At(5);
  const Vec3 ahead = last.q_WB * Vec3::UnitX();
  const double turned = std::atan2(ahead.y(), ahead.x()) - 0.7;
  const double ideal = 0.225 * (last.angle_rad[kRightTrack] - last.angle_rad[kLeftTrack]) / 1.148;
  EXPECT_NEAR(turned / ideal, 0.985, 0.02);  // the shoes slide sideways, at a small loss
}

TEST(MujocoCourse, JointsTurnAtTheRatesOfTheirLevers) {
  for (const std::size_t axis : {kSlew, kBoom, kArm, kBucket}) {
    const Course course = DriveBy(Pushes(axis, 0.6, 0.9), 1.3);
    EXPECT_NEAR(course.At(1.2).rate_radps[axis], 0.6 * FourTons().full_rate_radps[axis],
                0.02 * FourTons().full_rate_radps[axis])
        << kAxisNames[axis];
  }
}

TEST(MujocoCourse, AGapIsCrossedBeforeALinkFollows) {
  PlantForm form;
  form.drives[kSlew].gap_rad = 0.03;
  const Operator back_and_forth = [](double t_s, const Instant&) {
    PerAxis<double> levers{};
    if (t_s < 3.2) levers[kSlew] = 0.3 * std::sin(2 * M_PI * t_s / 3.2);
    return levers;
  };
  const double with = DriveBy(back_and_forth, 4, form).At(4).angle_rad[kSlew];
  const double without = DriveBy(back_and_forth, 4).At(4).angle_rad[kSlew];
  // Pushed one way and back equally far: the motor returns to its start, the link lags by a gap,
  // minus its initial lag in the middle of the gap.
  EXPECT_GT(with - without, 0.012);
  EXPECT_LT(with - without, 0.03);
}

}  // namespace
}  // namespace tera::blind::mujoco
