#include "diagnose/motion/starting_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

TEST(TimeSeries, IsLinearBetweenAndConstantBeyond) {
  const TimeSeries series = {{1, 2, 4}, {10, 20, 0}};
  EXPECT_DOUBLE_EQ(series.At(0), 10);
  EXPECT_DOUBLE_EQ(series.At(1.5), 15);
  EXPECT_DOUBLE_EQ(series.At(2), 20);
  EXPECT_DOUBLE_EQ(series.At(3), 10);
  EXPECT_DOUBLE_EQ(series.At(9), 0);
  EXPECT_TRUE(std::isfinite(TimeSeries({{1, 1}, {3, 5}}).At(1)));
}

/// A base that turns by two turns in 20 s while it drives along.
Pose TurningBase(double t) {
  return MakePose({5 + 0.5 * t, 2 * std::sin(0.4 * t), 1.5}, 0, 0, 2.5 + 0.6 * t);
}

AntennaTrack Antenna(const Vec3& p_B_m, double from_s, double to_s, Pose (*base)(double)) {
  AntennaTrack track;
  track.p_L_m = p_B_m;
  for (double t = from_s; t <= to_s + 1e-9; t += 0.1) {
    track.t_s.push_back(t);
    track.p_W_m.push_back(base(t) * p_B_m);
  }
  return track;
}

const Vec3 kLeft_B_m(-0.9, 0.5, 2.1), kRight_B_m(-0.7, -0.6, 2.1);

void ExpectNear(const std::array<TimeSeries, kBaseNumbers>& base, Pose (*truth)(double), double t,
                double place_m, double angle_rad) {
  const Pose X_WB = truth(t);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(base[k].At(t), X_WB.translation()[k], place_m) << t;
  const Mat3 R = RotationFromRpy(base[3].At(t), base[4].At(t), base[5].At(t));
  EXPECT_LT(Eigen::AngleAxisd(R.transpose() * X_WB.linear()).angle(), angle_rad) << t;
}

/// No step between values exceeds a quarter turn.
void ExpectContinuousYaw(const TimeSeries& yaw) {
  for (std::size_t k = 1; k < yaw.value.size(); ++k) {
    EXPECT_LT(std::abs(yaw.value[k] - yaw.value[k - 1]), kPi / 2) << yaw.t_s[k];
  }
}

TEST(RoughBase, OfTwoAntennasTurnsOnPastAHalfTurn) {
  RoughSources sources;
  sources.antennas = {Antenna(kLeft_B_m, 0, 20, TurningBase),
                      Antenna(kRight_B_m, 0, 20, TurningBase)};
  const auto base = RoughBase(sources);
  for (double t = 0.1; t <= 20; t += 0.37) ExpectNear(base, TurningBase, t, 0.05, 0.05);
  ExpectContinuousYaw(base[kYaw]);
  EXPECT_NEAR(base[kYaw].At(20) - base[kYaw].At(1), 11.4, 0.05) << "0.6 rad/s for 19 s";
}

// The antennas of different receivers have different sample times.
TEST(RoughBase, OfTwoAntennasThatAreReadInTurnIsAsGood) {
  RoughSources sources;
  sources.antennas = {Antenna(kLeft_B_m, 0, 20, TurningBase),
                      Antenna(kRight_B_m, 0.05, 20.05, TurningBase)};
  const auto base = RoughBase(sources);
  for (double t = 0.1; t <= 20; t += 0.37) ExpectNear(base, TurningBase, t, 0.1, 0.1);
  ExpectContinuousYaw(base[kYaw]);
}

TEST(RoughBase, OfAnAntennaThatIsLostInTheMiddleIsFiniteAndRightOutside) {
  RoughSources sources;
  sources.antennas = {Antenna(kLeft_B_m, 0, 20, TurningBase),
                      Antenna(kRight_B_m, 0, 20, TurningBase)};
  AntennaTrack& right = sources.antennas[1];
  right.t_s.erase(right.t_s.begin() + 60, right.t_s.begin() + 90);
  right.p_W_m.erase(right.p_W_m.begin() + 60, right.p_W_m.begin() + 90);
  const auto base = RoughBase(sources);
  for (double t = 0; t <= 20; t += 0.37) {
    if (t < 5.5 || t > 9.5) ExpectNear(base, TurningBase, t, 0.1, 0.1);
    for (const TimeSeries& number : base) EXPECT_TRUE(std::isfinite(number.At(t))) << t;
  }
}

TEST(RoughBase, OfTwoAntennasThatNeverMeetInTimeIsFinite) {
  RoughSources sources;
  sources.antennas = {Antenna(kLeft_B_m, 0, 5, TurningBase),
                      Antenna(kRight_B_m, 12, 20, TurningBase)};
  const auto base = RoughBase(sources);
  for (double t = 0; t <= 20; t += 0.37) {
    for (const TimeSeries& number : base) EXPECT_TRUE(std::isfinite(number.At(t))) << t;
  }
}

/// A permanently tilted base.
Pose LeaningBase(double t) {
  return MakePose({1 + t, 3, 0.5}, RotationFromRpy(0.1, -0.2, 3.0 + 0.4 * t));
}

TEST(RoughBase, OfRecordedPosesIsThese) {
  RoughSources sources;
  for (double t = 0; t <= 10; t += 0.1) {
    sources.poses_t_s.push_back(t);
    sources.poses.push_back(LeaningBase(t));
  }
  sources.antennas = {Antenna(kLeft_B_m, 0, 10, TurningBase)};
  const auto base = RoughBase(sources);
  for (double t = 0; t <= 10; t += 0.33) ExpectNear(base, LeaningBase, t, 0.01, 0.01);
  ExpectContinuousYaw(base[kYaw]);
}

TEST(RoughBase, OfPosesThatNeverChangeIsConstant) {
  RoughSources sources;
  const Pose X_WB = MakePose({7, -2, 0.3}, 0.05, -0.1, -kPi + 1e-9);
  for (double t = 0; t <= 10; t += 0.1) {
    sources.poses_t_s.push_back(t);
    sources.poses.push_back(X_WB);
  }
  const auto base = RoughBase(sources);
  for (double t = -1; t <= 11; t += 0.5) {
    EXPECT_NEAR(base[0].At(t), 7, 1e-12);
    EXPECT_NEAR(base[3].At(t), 0.05, 1e-9);
    EXPECT_NEAR(std::cos(base[kYaw].At(t)), -1, 1e-9);
    EXPECT_NEAR(base[kYaw].At(t), base[kYaw].At(0), 1e-9);
  }
}

/// Windows of 0.2 s of a base that drives at 1 m/s and turns at 0.3 rad/s.
std::vector<TravelWindow> Circle() {
  std::vector<TravelWindow> travel;
  for (int k = 0; k < 50; ++k) travel.push_back({0.2 * k, 0.2 * k + 0.2, 1, 0.3, false});
  return travel;
}
constexpr double kRadius_m = 1 / 0.3;
/// Start at (10, 20) with a heading of 100 deg.
Pose CirclingBase(double t) {
  const double yaw0 = 100 * kDeg, yaw = yaw0 + 0.3 * t;
  return MakePose({10 + kRadius_m * (std::sin(yaw) - std::sin(yaw0)),
                   20 - kRadius_m * (std::cos(yaw) - std::cos(yaw0)), 0.7},
                  0, 0, yaw);
}

TEST(RoughBase, WithoutAntennasIsRunningGearFromTheStart) {
  RoughSources sources;
  sources.travel = Circle();
  sources.start = CirclingBase(0);
  const auto base = RoughBase(sources);
  for (double t = 0; t <= 10; t += 0.37) ExpectNear(base, CirclingBase, t, 0.05, 0.02);
}

TEST(RoughBase, OfOneAntennaLaysRunningGearOverItsPlaces) {
  RoughSources sources;
  sources.travel = Circle();
  sources.antennas = {Antenna(kLeft_B_m, 0, 10, CirclingBase)};
  const auto base = RoughBase(sources);
  for (double t = 0; t <= 10; t += 0.37) ExpectNear(base, CirclingBase, t, 0.3, 0.1);
}

TEST(RoughBase, OfNothingAtAllIsFinite) {
  for (const auto& start : {std::optional<Pose>(), std::optional<Pose>(CirclingBase(0))}) {
    RoughSources sources;
    sources.start = start;
    const auto base = RoughBase(sources);
    for (const TimeSeries& number : base) {
      if (!number.empty()) {
        EXPECT_TRUE(std::isfinite(number.At(3)));
      }
    }
    if (start) {
      ASSERT_FALSE(base[0].empty());
      EXPECT_NEAR(base[0].At(3), 10, 1e-9);
      EXPECT_NEAR(base[kYaw].At(3), 100 * kDeg, 1e-9);
    }
  }
}

// An antenna on the axis of a standing machine does not determine its heading.
TEST(RoughBase, OfOneAntennaAndNoTravelIsFinite) {
  RoughSources sources;
  sources.antennas = {Antenna(kLeft_B_m, 0, 10, [](double) { return TurningBase(1); })};
  sources.start = TurningBase(1);
  const auto base = RoughBase(sources);
  for (double t = 0; t <= 10; t += 1)
    ExpectNear(
        base, [](double) { return TurningBase(1); }, t, 0.01, 0.01);
}

// The normal of the plane z = a x + b y + c is along (-a, -b, 1).
TEST(OnGround, OfASlopeStandsOnIt) {
  const double a = 0.08, b = -0.05, c = 2;
  const GroundHeight plane = [=](double x, double y) { return a * x + b * y + c; };
  for (const double yaw : {0.0, 1.0, 3.0, -2.0}) {
    const Vec3 on = OnGround(plane, 3, -4, yaw);
    EXPECT_NEAR(on[0], 3 * a - 4 * b + c, 1e-9) << yaw;
    const Vec3 up = RotationFromRpy(on[1], on[2], yaw).col(2);
    EXPECT_LT((up - Vec3(-a, -b, 1).normalized()).norm(), 2e-3) << yaw;
  }
}

}  // namespace
}  // namespace tera
