#include "diagnose/motion/linearise.h"

#include <gtest/gtest.h>

#include <string>

#include "core/units.h"
#include "diagnose/motion/link_motion.h"
#include "diagnose/motion/made_problem.h"

// Residuals against geometry, derivatives against differences of residuals.

namespace tera {
namespace {

using enum ObservationKind;

/// The residual after `change` of a copy of the problem.
template <typename Change>
Eigen::VectorXd ResidualAfter(MadeProblem made, const Observation& seen, const Change& change) {
  change(&made);
  LinearisedObservation rows;
  EXPECT_TRUE(made.Of(seen, &rows));
  return rows.residual.head(rows.rows);
}

/// Central difference of the residual by the number at `number`.
template <typename Number>
Eigen::VectorXd Difference(const MadeProblem& made, const Observation& seen, const Number& number) {
  const double step = 1e-5;
  const auto moved = [&](double by) {
    return ResidualAfter(made, seen, [&](MadeProblem* copy) { *number(copy) += by; });
  };
  return (moved(step) - moved(-step)) / (2 * step);
}

std::string Told(const Observation& seen) {
  return "kind " + std::to_string(static_cast<int>(seen.kind)) + " from " +
         std::to_string(seen.from_s);
}

// Derivatives are of the prediction; the residual has their negative.
TEST(Linearise, HasTheDerivativesByTheMotionOfEveryKindOfObservation) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const MadeProblem made(seed);
    for (const Observation& seen : made.Observations()) {
      LinearisedObservation rows;
      ASSERT_TRUE(made.Of(seen, &rows)) << Told(seen);
      const Eigen::MatrixXd by = made.ByCoefficients(rows);
      for (int i = 0; i < by.cols(); ++i) {
        const int row = i / made.problem.numbers(), number = i % made.problem.numbers();
        const Eigen::VectorXd expected = -Difference(
            made, seen, [&](MadeProblem* copy) { return &copy->coefficients(row, number); });
        EXPECT_LT((by.col(i) - expected).norm(), 2e-6 * (1 + expected.norm()))
            << Told(seen) << ", coefficient " << row << " of number " << number << ": "
            << by.col(i).transpose() << " instead of " << expected.transpose();
      }
    }
  }
}

TEST(Linearise, HasTheDerivativesByTheParametersOfEveryKindOfObservation) {
  for (const std::uint64_t seed : {4, 5, 6}) {
    const MadeProblem made(seed);
    for (const Observation& seen : made.Observations()) {
      LinearisedObservation rows;
      ASSERT_TRUE(made.Of(seen, &rows)) << Told(seen);
      const Eigen::MatrixXd by = made.ByParameters(rows);
      for (int i = 0; i < by.cols(); ++i) {
        const Eigen::VectorXd expected =
            -Difference(made, seen, [&](MadeProblem* copy) { return &copy->parameters[i]; });
        EXPECT_LT((by.col(i) - expected).norm(), 2e-3 * (0.01 + expected.norm()))
            << Told(seen) << ", parameter " << i << ": " << by.col(i).transpose() << " instead of "
            << expected.transpose();
      }
    }
  }
}

// The derivatives by the motion, mount, place and gains of a filtered unit are others.
TEST(Linearise, HasTheDerivativesByTheNumbersOfAFilteredUnit) {
  MadeProblem made(7);
  UnitChannel& unit = made.problem.imus[0];
  unit.low_pass = made.problem.parameters++;
  made.parameters.conservativeResize(made.problem.parameters);
  made.parameters[unit.low_pass] = 0.12;
  for (const Observation& seen : made.Observations()) {
    if (seen.kind != kImu) continue;
    LinearisedObservation rows;
    ASSERT_TRUE(made.Of(seen, &rows));
    EXPECT_TRUE(rows.by_state.isZero());
    const Eigen::MatrixXd by = made.ByParameters(rows);
    std::vector<int> numbers = {unit.low_pass, unit.late, unit.clipped, unit.clipped + 1};
    for (int i = 0; i < 6; ++i) {
      numbers.push_back(unit.bias + i);
      numbers.push_back(unit.scale + i);
    }
    for (const int i : numbers) {
      const Eigen::VectorXd expected =
          -Difference(made, seen, [&](MadeProblem* copy) { return &copy->parameters[i]; });
      // Between instants the filtered measurement is linear, its derivative by time a step.
      const double share = i == unit.late ? 0.4 : 0.03;
      EXPECT_LT((by.col(i) - expected).norm(), share * (0.01 + expected.norm()))
          << Told(seen) << ", parameter " << i << ": " << by.col(i).transpose() << " instead of "
          << expected.transpose();
    }
  }
}

// Forward motion of a gear is no sideways motion: the latter has its own row.
TEST(Linearise, HasAsManyRowsAsWasMeasured) {
  const MadeProblem made(7);
  const int expected[] = {6, 3, 1, 6, 3};
  for (const Observation& seen : made.Observations()) {
    LinearisedObservation rows;
    ASSERT_TRUE(made.Of(seen, &rows));
    if (seen.kind <= kTravel) {
      EXPECT_EQ(rows.rows, expected[static_cast<int>(seen.kind)]);
    }
    if (seen.kind == kGround) {
      EXPECT_EQ(rows.rows, 3);
    }
    EXPECT_LE(rows.parameters, LinearisedObservation::kMostParameters);
    EXPECT_TRUE(rows.residual.head(rows.rows).allFinite());
    if (rows.noise == kNoParameter) {
      EXPECT_GT(rows.sigma.head(rows.rows).minCoeff(), 0) << Told(seen);
    }
  }
}

TEST(Linearise, OfATimeThatTheMotionDoesNotCoverIsFalse) {
  MadeProblem made(8);
  const double end_s = made.spline.end_s();
  LinearisedObservation rows;
  made.parameters.setZero();
  for (const int late : {made.problem.imus[0].late, made.problem.receivers[0].late,
                         made.problem.axes[0].late, made.problem.poses[0].late}) {
    made.parameters[late] = 0;
  }
  for (Observation seen : made.Observations()) {
    seen.from_s = -0.2, seen.to_s = -0.1;
    EXPECT_FALSE(made.Of(seen, &rows)) << Told(seen);
    seen.from_s = end_s + 0.1, seen.to_s = end_s + 0.2;
    EXPECT_FALSE(made.Of(seen, &rows)) << Told(seen);
    seen.from_s = seen.to_s = end_s;
    EXPECT_TRUE(made.Of(seen, &rows)) << Told(seen);
    EXPECT_TRUE(rows.residual.head(rows.rows).allFinite()) << Told(seen);
    seen.from_s = seen.to_s = 0;
    EXPECT_TRUE(made.Of(seen, &rows)) << Told(seen);
  }
  // With a delay of 0.3 s, a stamp of 0.2 s precedes the motion.
  made.parameters[made.problem.axes[0].late] = 0.3;
  EXPECT_FALSE(made.Of({.kind = kAxis, .from_s = 0.2, .to_s = 0.2}, &rows));
  EXPECT_TRUE(made.Of({.kind = kAxis, .from_s = 0.4, .to_s = 0.4}, &rows));
}

/// The base's pose and the positions of hinge and slide at a time.
struct MotionThere {
  Pose X_WB;
  double q[2];
};

double NumberAt(const MadeProblem& made, int number, double t, int derivative = 0) {
  const SplineWeights weights = made.spline.At(t);
  double sum = 0;
  for (int k = 0; k < 5; ++k) {
    if (weights.first + k >= made.spline.coefficients) continue;
    sum += weights.by_derivative(derivative, k) * made.coefficients(weights.first + k, number);
  }
  return sum;
}

MotionThere MotionAt(const MadeProblem& made, double t) {
  Vec3 p, rpy;
  for (int k = 0; k < 3; ++k) {
    p[k] = NumberAt(made, k, t);
    rpy[k] = NumberAt(made, kRoll + k, t);
  }
  return {MakePose(p, RotationFromRpy(rpy[0], rpy[1], rpy[2])),
          {NumberAt(made, 6, t), NumberAt(made, 7, t)}};
}

constexpr double kTime_s = 1.31, kLate_s = 0.07;

TEST(Linearise, PredictsAnAntennaAtItsPlaceOfTheTimeBefore) {
  MadeProblem made(9);
  const ReceiverChannel& receiver = made.problem.receivers[0];
  made.parameters.setZero();
  made.parameters[receiver.late] = kLate_s;
  made.parameters.segment<3>(receiver.place) = Vec3(0.1, -0.2, 0.3);
  made.parameters.segment<3>(receiver.datum) = Vec3(1, 2, -3);
  const MotionThere at = MotionAt(made, kTime_s - kLate_s);
  const Vec3 p_B =
      PointInBase<double>(receiver.chain, receiver.p_LS_m + Vec3(0.1, -0.2, 0.3), at.q);
  Observation seen = {.kind = kReceiver, .from_s = kTime_s, .to_s = kTime_s};
  seen.value.head<3>() = at.X_WB * p_B + Vec3(1, 2, -3);
  LinearisedObservation rows;
  ASSERT_TRUE(made.Of(seen, &rows));
  EXPECT_LT(rows.residual.head<3>().norm(), 1e-12) << rows.residual.transpose();
}

// A pair turned by a right angle about its middle: the left antenna, 0.7 m left of the middle, is
// now 0.7 m behind it.
TEST(Linearise, TurnsAPairAboutItsMiddle) {
  MadeProblem made(10);
  const ReceiverChannel& receiver = made.problem.receivers[0];
  made.parameters.setZero();
  made.parameters[receiver.pair_yaw] = kPi / 2;
  const MotionThere at = MotionAt(made, kTime_s);
  const Vec3 p_L = receiver.middle_L_m + Vec3(-0.7, 0, 0);
  Observation seen = {.kind = kReceiver, .from_s = kTime_s, .to_s = kTime_s};
  seen.value.head<3>() = at.X_WB * PointInBase<double>(receiver.chain, p_L, at.q);
  LinearisedObservation rows;
  ASSERT_TRUE(made.Of(seen, &rows));
  EXPECT_LT(rows.residual.head<3>().norm(), 1e-12) << rows.residual.transpose();
}

TEST(Linearise, PredictsAnEncoderByScaleBiasAndDelay) {
  MadeProblem made(11);
  const AxisChannel& axis = made.problem.axes[0];
  made.parameters[axis.late] = kLate_s;
  made.parameters[axis.scale] = 1.1;
  made.parameters[axis.bias] = 0.02;
  Observation seen = {.kind = kAxis, .from_s = kTime_s, .to_s = kTime_s};
  seen.value[0] = 1.1 * NumberAt(made, axis.number, kTime_s - kLate_s) + 0.02 + 0.5;
  LinearisedObservation rows;
  ASSERT_TRUE(made.Of(seen, &rows));
  EXPECT_NEAR(rows.residual[0], 0.5, 1e-12) << "measured less predicted";
}

TEST(Linearise, PredictsPosesInAMapThatIsTurnedAboutItsPivotAndShifted) {
  MadeProblem made(12);
  const MapChannel& map = made.problem.poses[0];
  made.parameters.setZero();
  made.parameters[map.late] = kLate_s;
  const Vec3 turn(0.1, -0.2, 0.3), shift(0.4, -0.5, 0.6);
  made.parameters.segment<3>(map.turn) = turn;
  made.parameters.segment<3>(map.shift) = shift;
  const Pose X_LB = MotionAt(made, kTime_s - kLate_s).X_WB;
  const Mat3 R_ML = RotationFromRpy(turn[0], turn[1], turn[2]).transpose();
  Observation seen = {.kind = kPose, .from_s = kTime_s, .to_s = kTime_s};
  seen.value.head<3>() = map.pivot_m + R_ML * (X_LB.translation() - map.pivot_m) + shift;
  seen.value.tail<3>() = RpyFromRotation(R_ML * X_LB.linear());
  LinearisedObservation rows;
  ASSERT_TRUE(made.Of(seen, &rows));
  EXPECT_LT(rows.residual.norm(), 1e-12) << rows.residual.transpose();
  // A heading plus a whole turn is the same.
  seen.value[5] -= 4 * kPi;
  ASSERT_TRUE(made.Of(seen, &rows));
  EXPECT_LT(rows.residual.norm(), 1e-11) << rows.residual.transpose();
}

// Over a short time, in which no product of motions changes.
TEST(Linearise, PredictsAnInertialUnitByTheMotionOfItsTrueFrame) {
  MadeProblem made(13);
  UnitChannel& unit = made.problem.imus[0];
  unit.signs.setOnes();
  made.parameters.setZero();
  const Vec3 turn(0.1, -0.2, 0.3), shift(0.2, 0.1, -0.3);
  made.parameters.segment<3>(unit.mount) = turn;
  made.parameters.segment<3>(unit.place) = shift;
  made.parameters[unit.late] = kLate_s;
  Eigen::Matrix<double, 6, 1> scale, bias;
  scale << 1.1, 0.9, 1.2, 0.8, 1.05, 0.95;
  bias << 0.1, -0.2, 0.3, -0.4, 0.5, -0.6;
  made.parameters.segment<6>(unit.scale) = scale;
  made.parameters.segment<6>(unit.bias) = bias;
  // Poses of the sensor, whose differences give its measurements.
  Pose X_LS = unit.X_LS;
  X_LS.translation() += shift;
  X_LS.linear() = unit.X_LS.linear() * RotationFromRpy(turn[0], turn[1], turn[2]);
  const auto sensor = [&](double t) {
    const MotionThere at = MotionAt(made, t);
    const Vec3 o = PointInBase<double>(unit.chain, Vec3::Zero(), at.q);
    Pose X_BL = Pose::Identity();
    X_BL.translation() = o;
    for (int k = 0; k < 3; ++k) {
      X_BL.linear().col(k) = PointInBase<double>(unit.chain, Vec3::Unit(k), at.q) - o;
    }
    return Pose(at.X_WB * X_BL * X_LS);
  };
  const double t = kTime_s - kLate_s, h = 1e-4;
  const Pose before = sensor(t - h), now = sensor(t), after = sensor(t + h);
  const Eigen::AngleAxisd turned(before.linear().transpose() * after.linear());
  const Vec3 w = turned.axis() * turned.angle() / (2 * h);
  const Vec3 a_W = (before.translation() - 2 * now.translation() + after.translation()) / (h * h);
  const Vec3 f = now.linear().transpose() * (a_W + Vec3(0, 0, kStandardGravity_mps2));
  Observation seen = {.kind = kImu, .from_s = kTime_s - 1e-4, .to_s = kTime_s + 1e-4};
  seen.value << w, f;
  seen.value = seen.value.cwiseProduct(scale) + bias;
  LinearisedObservation rows;
  ASSERT_TRUE(made.Of(seen, &rows));
  EXPECT_LT(rows.residual.norm(), 2e-3) << rows.residual.transpose();
}

/// A base that drives ahead at 2 m/s with a heading of 40 deg and turns at 0.3 rad/s.
MadeProblem Driving() {
  MadeProblem made(14);
  made.coefficients.setZero();
  for (int i = 0; i < made.spline.coefficients; ++i) {
    const double t = (i - 1) * made.spline.step_s;
    made.coefficients(i, 0) = 2 * std::cos(40 * kDeg) * t;
    made.coefficients(i, 1) = 2 * std::sin(40 * kDeg) * t;
    made.coefficients(i, kYaw) = 40 * kDeg + 0.3 * (t - 1.5);
  }
  return made;
}

TEST(Linearise, PredictsTravelAheadAndTurning) {
  const MadeProblem made = Driving();
  Observation seen = {.kind = kTravel, .from_s = 1.49, .to_s = 1.51};
  seen.value.head<2>() << 2, 0.3;
  LinearisedObservation rows;
  ASSERT_TRUE(made.Of(seen, &rows));
  EXPECT_LT(rows.residual.head(rows.rows).cwiseAbs().maxCoeff(), 1e-3) << rows.residual.transpose();
}

TEST(Linearise, OfStillGearPredictsNoMotion) {
  MadeProblem made = Driving();
  Observation seen = {.kind = kStill, .from_s = 1.49, .to_s = 1.51};
  LinearisedObservation rows;
  ASSERT_TRUE(made.Of(seen, &rows));
  EXPECT_GT(rows.residual.head(rows.rows).norm(), 1) << "2 m/s are not still";
  made.coefficients.rowwise() = Eigen::RowVectorXd::LinSpaced(8, -1, 2);
  ASSERT_TRUE(made.Of(seen, &rows));
  EXPECT_LT(rows.residual.head(rows.rows).norm(), 1e-12);
}

TEST(Linearise, OfGroundPredictsHeightRollAndPitch) {
  const MadeProblem made(15);
  Observation seen = {.kind = kGround, .from_s = 1.3, .to_s = 1.3};
  for (int k = 0; k < 3; ++k) seen.value[k] = NumberAt(made, 2 + k, 1.3) + 0.1 * (k + 1);
  LinearisedObservation rows;
  ASSERT_TRUE(made.Of(seen, &rows));
  EXPECT_LT((rows.residual.head<3>() - Vec3(0.1, 0.2, 0.3)).norm(), 1e-12);
}

// A motion below its noise does not excite a unit's scale.
TEST(Linearise, OfAMotionThatRestsHasNoDerivativesByWhatOnlyMotionExcites) {
  MadeProblem made(16);
  made.moving.setZero();
  const UnitChannel& unit = made.problem.imus[0];
  LinearisedObservation rows;
  ASSERT_TRUE(made.Of({.kind = kImu, .from_s = 1.3, .to_s = 1.4}, &rows));
  const Eigen::MatrixXd by = made.ByParameters(rows);
  EXPECT_LT(by.middleCols(unit.scale, 3).norm(), 1e-12) << "of rates";
  EXPECT_LT(by.middleCols(unit.place, 3).norm(), 1e-12);
  EXPECT_LT(by.col(unit.late).norm(), 1e-12);
  EXPECT_GT(by.middleCols(unit.bias, 6).norm(), 2);
  EXPECT_GT(by.middleCols(unit.mount, 3).norm(), 9) << "gravity stays";
}

}  // namespace
}  // namespace tera
