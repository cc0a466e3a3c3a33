#include "survey/align/registration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "core/units.h"
#include "survey/align/registration_hints.h"

// Clouds with a known pose, from surfaces sampled anew for each.

namespace tera {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using testing::UnorderedElementsAre;

/// Points of rectangles, each with its own noise.
class Sampler {
 public:
  Sampler(unsigned seed, double noise_m) : random_(seed), noise_(0, noise_m) {}

  void Rectangle(const Vec3& corner, const Vec3& u, const Vec3& v, int count) {
    std::uniform_real_distribution<double> along(0, 1);
    for (int k = 0; k < count; ++k) {
      const double a = along(random_), b = along(random_);
      const Vec3 noise(noise_(random_), noise_(random_), noise_(random_));
      points_.push_back(corner + a * u + b * v + noise);
    }
  }
  void Box(const Vec3& corner, const Vec3& size, int count) {
    const Vec3 x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
    Rectangle(corner + z, x, y, count);
    Rectangle(corner, x, z, count);
    Rectangle(corner + y, x, z, count);
    Rectangle(corner, y, z, count);
    Rectangle(corner + x, y, z, count);
  }
  const std::vector<Vec3>& points() const { return points_; }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> noise_;
  std::vector<Vec3> points_;
};

constexpr double kNoise_m = 0.01;

/// A yard with two walls and three boxes on it.
std::vector<Vec3> Yard(unsigned seed) {
  Sampler sampler(seed, kNoise_m);
  sampler.Rectangle({-8, -6, 0}, {16, 0, 0.5}, {0, 12, 0}, 6000);
  sampler.Rectangle({-8, 6, 0}, {16, 0, 0}, {0, 0, 3}, 2400);
  sampler.Rectangle({8, -6, 0.5}, {0, 12, 0}, {0.6, 0, 3}, 1800);
  sampler.Box({-4, -2, 0.2}, {2, 1.2, 1.5}, 250);
  sampler.Box({3, 1, 0.3}, {1.5, 1.5, 1.0}, 250);
  sampler.Box({1, -4, 0.3}, {1, 2.5, 2}, 250);
  return sampler.points();
}

std::vector<Vec3> InFrame(const std::vector<Vec3>& points, const Pose& X_AB) {
  std::vector<Vec3> in_b;
  for (const Vec3& p : points) in_b.push_back(X_AB.inverse() * p);
  return in_b;
}

Vec6 ErrorOf(const Registration& found, const Pose& X_AB) {
  const Eigen::AngleAxisd turn(found.X_AB.linear() * X_AB.linear().transpose());
  Vec6 error;
  error << found.X_AB.translation() - X_AB.translation(), turn.angle() * turn.axis();
  return error;
}

TEST(Registration, FindsAPoseFromHalfAMetreAndFiveDegreesAway) {
  const Pose X_AB = MakePose({0.4, -0.25, 0.15}, 1 * kDeg, -2 * kDeg, 5 * kDeg);
  const Registration found = Register(Yard(1), InFrame(Yard(2), X_AB), {});
  EXPECT_EQ(found.status, RegistrationStatus::kRegistered);
  const Vec6 error = ErrorOf(found, X_AB);
  EXPECT_LT(error.head<3>().norm(), 0.005);
  EXPECT_LT(error.tail<3>().norm(), 0.05 * kDeg);
  EXPECT_GT(found.overlap_of_A, 0.95);
  EXPECT_GT(found.overlap_of_B, 0.95);
  EXPECT_TRUE(found.open.empty());
  EXPECT_NEAR(found.residual_m, kNoise_m, 0.25 * kNoise_m);
}

TEST(Registration, AStartFarFromTheOriginOfBothIsNoHarder) {
  // A lies in a map, B in its own frame.
  const Pose X_MA = MakePose({432'100, 5'245'700, 460});
  const Pose X_AB = MakePose({10, 20, 3}, 0, 0, 70 * kDeg);
  std::vector<Vec3> a;
  for (const Vec3& p : Yard(3)) a.push_back(X_MA * p);
  RegistrationRequest request;
  request.X_AB_start = X_MA * MakePose({10.3, 19.8, 3.1}, 0, 0, 68 * kDeg);
  const Registration found = Register(a, InFrame(Yard(4), X_AB), request);
  EXPECT_EQ(found.status, RegistrationStatus::kRegistered);
  EXPECT_LT(ErrorOf(found, X_MA * X_AB).head<3>().norm(), 0.01);
}

// The squared error over the stated covariance is chi-squared of six: 95 % of it below 12.59, its
// mean 6. At least 51 of 60 trials lie below: 57 expected minus five standard deviations (1.7) is
// 48.6. The mean of 60 has a standard deviation of 0.45.
TEST(Registration, ErrorsAreAsLargeAsTheCovarianceSays) {
  constexpr int kTrials = 60;
  constexpr double kWithin = 12.59;
  int within = 0;
  double sum = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double s = trial - 0.5 * kTrials;
    const Pose X_AB =
        MakePose({0.01 * s, 0.2 - 0.007 * s, 0.002 * s}, 0.0005 * s, 0.01, 0.03 - 0.001 * s);
    const auto seed = static_cast<unsigned>(100 + 2 * trial);
    const Registration found = Register(Yard(seed), InFrame(Yard(seed + 1), X_AB), {});
    ASSERT_EQ(found.status, RegistrationStatus::kRegistered) << trial;
    const Vec6 error = ErrorOf(found, X_AB);
    const double square = error.dot(found.covariance.ldlt().solve(error));
    sum += square;
    within += square < kWithin ? 1 : 0;
  }
  RecordProperty("within", within);
  RecordProperty("mean", std::to_string(sum / kTrials));
  EXPECT_GE(within, 51);
  EXPECT_GT(sum / kTrials, 3.0);
  EXPECT_LT(sum / kTrials, 9.0);
}

TEST(Registration, AFlatFloorLeavesXYAndYawOpen) {
  Sampler a(11, kNoise_m), b(12, kNoise_m);
  for (Sampler* sampler : {&a, &b}) {
    sampler->Rectangle({-8, -8, 0}, {16, 0, 0}, {0, 16, 0}, 8000);
  }
  const Pose X_AB = MakePose({0.2, 0.1, 0.12}, 0.01, -0.02, 0.05);
  const Registration found = Register(a.points(), InFrame(b.points(), X_AB), {});
  EXPECT_EQ(found.status, RegistrationStatus::kOpen);
  EXPECT_THAT(found.open_axes, ElementsAre("x", "y", "yaw"));
  EXPECT_EQ(found.open.size(), 3u);
  EXPECT_THAT(found.ObservedAt(found.centre_A_m),
              ElementsAre(false, false, true, true, true, false));
  // It determines the observable part: the height of the floor's middle, and the floor's tilt.
  EXPECT_NEAR((found.X_AB * (X_AB.inverse() * Vec3::Zero())).z(), 0, 0.005);
  EXPECT_NEAR(found.X_AB.linear()(2, 0), X_AB.linear()(2, 0), 0.001);
}

TEST(Registration, AFloorAndAWallLeaveTheWaysAlongTheirEdgeOpen) {
  Sampler a(21, kNoise_m), b(22, kNoise_m);
  for (Sampler* sampler : {&a, &b}) {
    sampler->Rectangle({-8, -8, 0}, {16, 0, 0}, {0, 16, 0}, 6000);
    // A wall along (1, 1, 0).
    sampler->Rectangle({-5, -5, 0}, {10, 10, 0}, {0, 0, 4}, 4000);
  }
  const Pose X_AB = MakePose({0.1, -0.1, 0.05}, 0, 0.01, -0.02);
  const Registration found = Register(a.points(), InFrame(b.points(), X_AB), {});
  EXPECT_EQ(found.status, RegistrationStatus::kOpen);
  ASSERT_EQ(found.open.size(), 1u);
  const Vec3 along = found.open[0].translation.normalized();
  EXPECT_NEAR(std::abs(along.dot(Vec3(1, 1, 0).normalized())), 1, 0.01);
  // A shift along (1, 1, 0) is a combination of x and y.
  EXPECT_THAT(found.ObservedAt(found.centre_A_m),
              ElementsAre(false, false, true, true, true, true));
  // Across the edge it is found: the wall's plane is x = y.
  const Vec3 error = ErrorOf(found, X_AB).head<3>();
  EXPECT_LT(std::abs(error.dot(Vec3(1, -1, 0).normalized())), 0.01);
}

TEST(Registration, ATurnThatIsOpenMovesPlacesBesideItsAxis) {
  Registration found;
  found.centre_A_m = {1, 2, 3};
  found.reach_m = 4;
  found.open.push_back({.rotation = Vec3::UnitZ()});
  EXPECT_THAT(found.ObservedAt(found.centre_A_m), ElementsAre(true, true, true, true, true, false));
  EXPECT_THAT(found.ObservedAt({1, 7, 3}), ElementsAre(false, true, true, true, true, false));
}

TEST(Registration, CloudsThatShareNoPlaceAreNotAligned) {
  const Pose far_off = MakePose({80, 0, 0});
  const Registration found = Register(Yard(31), InFrame(Yard(32), far_off), {});
  EXPECT_EQ(found.status, RegistrationStatus::kNoOverlap);
  EXPECT_EQ(found.overlap_of_B, 0);
}

TEST(Registration, AHandfulOfPointsIsNoOverlap) {
  const std::vector<Vec3> few = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(Register(Yard(41), few, {}).status, RegistrationStatus::kNoOverlap);
  EXPECT_EQ(Register(few, few, {}).status, RegistrationStatus::kNoOverlap);
}

std::vector<Vec3> InUnitsOf(std::vector<Vec3> points, double unit_m) {
  for (Vec3& p : points) p /= unit_m;
  return points;
}

TEST(RegistrationHints, NameTheCloudThatIsInAnotherUnit) {
  const Pose X_AB = MakePose({0.2, -0.1, 0.1}, 0, 0, 2 * kDeg);
  const std::vector<Vec3> a = Yard(51), b = InFrame(Yard(52), X_AB);
  const auto hints = [](const std::vector<Vec3>& first, const std::vector<Vec3>& second) {
    return RegistrationHints(first, second, {}, Register(first, second, {}));
  };
  for (const auto& [name, unit_m] : {std::pair{"millimetres", 0.001}, {"feet", 0.3048}}) {
    EXPECT_THAT(hints(a, InUnitsOf(b, unit_m)),
                ElementsAre(AllOf(StartsWith("B "), HasSubstr(name))));
    EXPECT_THAT(hints(InUnitsOf(a, unit_m), b),
                ElementsAre(AllOf(StartsWith("A "), HasSubstr(name))));
  }
  EXPECT_THAT(hints(a, b), IsEmpty());
  EXPECT_THAT(hints(a, InFrame(b, MakePose({80, 0, 0}))), IsEmpty());
}

TEST(RegistrationHints, NameADistanceAsOfMaps) {
  const std::vector<Vec3> a = InFrame(Yard(53), MakePose({-432'100, -5'245'700, -460}));
  const std::vector<Vec3> b = Yard(54);
  EXPECT_THAT(RegistrationHints(a, b, {}, Register(a, b, {})),
              ElementsAre(HasSubstr("5263 km")));  // hypot(432, 5246)
}

}  // namespace
}  // namespace tera
