#include "diagnose/perception/registration/calibration_jacobian.h"

#include <gtest/gtest.h>

#include "core/units.h"
#include "diagnose/perception/registration/sensor_candidates.h"

namespace tera {
namespace {

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

}  // namespace
}  // namespace tera
