#include "diagnose/perception/registration/registration_block.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/units.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

using ::testing::ElementsAre;

const Pose kX_BS = MakePose({0.3, 0.2, 0.7}, 0.02, 0.2, -0.4);

/// A term of the candidate by that identifier.
Term TermOf(const std::vector<Candidate>& candidates, std::string_view id,
            const std::vector<double>& values) {
  for (const Candidate& one : candidates) {
    if (one.mechanism->id == id) return {&one, values};
  }
  ADD_FAILURE() << "no candidate " << id;
  return {};
}

TEST(CalibrationJacobian, OfAMountIsItsShiftsAndTheAxesThatItIsTurnedAbout) {
  const auto candidates = CandidatesOf(EffectTarget::kLidar, ComparedBy::kRanges, "lidar", {});
  const Structure mount = {TermOf(candidates, "extrinsic", {0.1, -0.2, 0.05, 20, -30, 40})};
  const CalibrationJacobian jacobian = JacobianOf(kX_BS, {}, mount);
  ASSERT_EQ(jacobian.cols(), 6);
  for (int a = 0; a < 3; ++a) {
    const CalibrationVector shift = jacobian.col(a), turn = jacobian.col(3 + a);
    EXPECT_NEAR((shift.head<3>() - Vec3::Unit(a)).norm(), 0, 1e-8) << a;
    EXPECT_NEAR(shift.tail<6>().norm(), 0, 1e-8) << a;
    EXPECT_NEAR(turn.head<3>().norm() + turn.tail<3>().norm(), 0, 1e-8) << a;
  }
  // Yaw turns about z of S, pitch about the y that yaw has turned, roll about the x that both have.
  const Mat3 R_BS = kX_BS.linear();
  const Mat3 yawed = RotationFromRpy(0, 0, 40 * kDeg);
  const Mat3 pitched = RotationFromRpy(0, -30 * kDeg, 40 * kDeg);
  const Vec3 axes_B[] = {R_BS * (pitched * Vec3::UnitX()), R_BS * (yawed * Vec3::UnitY()),
                         R_BS * Vec3::UnitZ()};
  for (int a = 0; a < 3; ++a) {
    const Vec3 turn_per_deg = jacobian.block<3, 1>(kTurnOfMount, 3 + a);
    EXPECT_NEAR((turn_per_deg / kDeg - axes_B[a]).norm(), 0, 1e-6) << a;
  }
}

TEST(CalibrationJacobian, HasAColumnForEachFreeParameterOfAllTermsInTheirOrder) {
  const auto candidates = CandidatesOf(EffectTarget::kCamera, ComparedBy::kRanges, "camera", {});
  Structure terms = {TermOf(candidates, "clock_offset", {0.3}),
                     TermOf(candidates, "extrinsic", {0, 0, 0, 0, 0, 0}),
                     TermOf(candidates, "range_bias", {0.1}), TermOf(candidates, "scale", {1.02})};
  terms[1].held = {0, 1, 3, 4, 5};
  const CalibrationJacobian jacobian = JacobianOf(kX_BS, {}, terms);
  ASSERT_EQ(jacobian.cols(), 4);
  const int elements[] = {kClockOffset, kShiftOfMount + 2, kRangeBias, kRangeFactor};
  for (int c = 0; c < 4; ++c) {
    CalibrationVector unit = CalibrationVector::Zero();
    unit[elements[c]] = 1;
    EXPECT_NEAR((jacobian.col(c) - unit).norm(), 0, 1e-6) << c;
  }
}

std::vector<std::string_view> IdsOf(const std::vector<Candidate>& candidates) {
  std::vector<std::string_view> ids;
  for (const Candidate& one : candidates) ids.push_back(one.mechanism->id);
  return ids;
}

const Mechanism& Known(std::string_view id, EffectTarget target) {
  return *std::find_if(SensorMechanisms().begin(), SensorMechanisms().end(),
                       [&](const Mechanism& one) { return one.id == id && one.ActsOn(target); });
}

TEST(SensorCandidates, AreTheMechanismsOfTheSensorsTableThatActOnItsKind) {
  const auto of_lidar = CandidatesOf(EffectTarget::kLidar, ComparedBy::kRanges, "roof", {});
  const auto of_depth = CandidatesOf(EffectTarget::kCamera, ComparedBy::kRanges, "front", {});
  const auto of_colour = CandidatesOf(EffectTarget::kCamera, ComparedBy::kPictures, "side", {});
  EXPECT_THAT(IdsOf(of_lidar), ElementsAre("extrinsic", "range_bias", "scale", "clock_offset"));
  EXPECT_THAT(IdsOf(of_depth), ElementsAre("extrinsic", "range_bias", "scale", "clock_offset"));
  EXPECT_THAT(IdsOf(of_colour), ElementsAre("extrinsic", "clock_offset"));
  for (const Candidate& one : of_lidar) {
    EXPECT_EQ(one.mechanism, &Known(one.mechanism->id, EffectTarget::kLidar));
    EXPECT_EQ(one.target, "roof");
  }
  EXPECT_EQ(of_lidar[1].mechanism->parameters[0].name, "range_m");
  EXPECT_EQ(of_depth[1].mechanism->parameters[0].name, "depth_m");
}

TEST(SensorCandidates, FreeAllParametersInTheRangesOfTheTableWithAPrior) {
  for (const Candidate& one : CandidatesOf(EffectTarget::kLidar, ComparedBy::kRanges, "roof", {})) {
    const auto& parameters = one.mechanism->parameters;
    ASSERT_EQ(one.free.size(), parameters.size()) << one.mechanism->id;
    for (const FreeParameter& free : one.free) {
      EXPECT_EQ(free.lower, parameters[free.index].lower);
      EXPECT_EQ(free.upper, parameters[free.index].upper);
      EXPECT_GT(free.prior_sigma, 0);
      EXPECT_LT(free.prior_sigma, free.upper - free.lower);
    }
  }
}

TEST(SensorCandidates, BeginWhereTheMechanismDoesNothing) {
  for (const Candidate& one : CandidatesOf(EffectTarget::kLidar, ComparedBy::kRanges, "roof", {})) {
    const double ideal = one.mechanism->id == "scale" ? 1 : 0;
    for (const double value : one.starts.front()) EXPECT_EQ(value, ideal) << one.mechanism->id;
  }
}

TEST(SensorCandidates, ThatTheScenarioHasAlreadyKnowTheirPresentNumbers) {
  const Effects present = {{&Known("range_bias", EffectTarget::kLidar), {0.2}}};
  const auto candidates = CandidatesOf(EffectTarget::kLidar, ComparedBy::kRanges, "roof", present);
  EXPECT_THAT(candidates[1].present, ElementsAre(0.2));
  EXPECT_TRUE(candidates[0].present.empty());
}

}  // namespace
}  // namespace tera
