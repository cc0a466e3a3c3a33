#include "layout/measures/joint_information.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/units.h"
#include "layout/measures/arm_filter.h"
#include "layout/measures/estimated_arm.h"

namespace tera {
namespace {

SensorDescription ImuOn(const std::string& link, const Pose& X_BS) {
  ImuModel model;
  model.gyro_noise_density_radpsrthz = 0.02 * kDeg;
  model.gyro_bias_random_walk_radps2rthz = 0.002 * kDeg;
  model.gyro_bias_radps.setConstant(0.2 * kDeg);
  model.accel_noise_density_mps2rthz = 0.003;
  model.accel_bias_random_walk_mps3rthz = 3e-4;
  model.accel_bias_mps2.setConstant(0.05);
  SensorDescription imu;
  imu.name = "imu_" + link;
  imu.link = link;
  imu.X_BS = X_BS;
  imu.clock.rate_hz = 50;
  imu.model = model;
  return imu;
}

SensorDescription SlewEncoder() {
  EncoderModel model;
  model.joints = {"slew"};
  model.noise_rad = 0.3 * kDeg;
  model.resolution_rad = 0.5 * kDeg;
  model.rate_noise_radps = 2 * kDeg;
  SensorDescription encoder;
  encoder.name = "encoders";
  encoder.clock.rate_hz = 10;
  encoder.model = model;
  return encoder;
}

SensorDescription Antenna(const std::string& name, const Vec3& p_BS_m) {
  GnssModel model;
  model.white_horizontal_m = 0.005;
  model.white_vertical_m = 0.009;
  model.correlated_horizontal_m = 0.007;
  model.correlated_vertical_m = 0.012;
  model.correlation_time_s = 60;
  SensorDescription antenna;
  antenna.name = name;
  antenna.link = "upper";
  antenna.X_BS = MakePose(p_BS_m);
  antenna.clock.rate_hz = 10;
  antenna.model = model;
  return antenna;
}

ArmLaw LawOf(const Arm& arm) {
  ArmLaw law{MotionCovariance::kResponse_s,
             Eigen::VectorXd::Constant(arm.coordinates(), 20 * kDeg / std::sqrt(3.0))};
  if (!arm.fixed_base) {
    law.rate_sigma.head<3>().setConstant(JointInformation::kRootSpeed_mps);
    law.rate_sigma.segment<3>(3).setConstant(JointInformation::kRootRate_radps);
  }
  return law;
}

/// The machine as simulated.
MachineState StateOf(const Arm& arm, const ArmMotion& motion) {
  constexpr double kAside_s = 1e-4;
  MachineState state;
  BodyState root;
  root.X_WB = arm.RootAt(motion.c);
  const Pose X_later = arm.RootAt(motion.c + kAside_s * motion.v);
  root.v_WB_mps = (X_later.translation() - root.X_WB.translation()) / kAside_s;
  const Eigen::AngleAxisd turn(Mat3(X_later.linear() * root.X_WB.linear().transpose()));
  root.w_WB_radps = turn.axis() * turn.angle() / kAside_s;
  state.links = {root};
  const Vec3 q = motion.c.tail<3>(), qd = motion.v.tail<3>();
  state.q_rad.assign(q.begin(), q.end());
  state.qd_radps.assign(qd.begin(), qd.end());
  return state;
}

double HeadingOf(const Arm& arm, const Eigen::VectorXd& c) {
  const Vec3 x_W = arm.LinkAt(1, c).linear().col(0);
  return std::atan2(x_W.y(), x_W.x());
}

using Deviations = std::map<std::string, double>;  ///< root mean square, in deg

constexpr int kWarm = 250, kSamples = 400;  ///< 5 s to converge, 3 s that are evaluated, at 50 Hz
constexpr int kEverySamples = 25;

Deviations Predicted(const Arm& arm, const std::vector<SensorDescription>& rig, int courses) {
  const MachineModel model = arm.Model();
  Deviations squares;
  int moments = 0;
  for (int seed = 0; seed < courses; ++seed) {
    const auto course = DrawCourse(arm, LawOf(arm), kSamples * kStepsASample, seed);
    JointInformation information(model, 1, rig, 0);
    for (int k = 0; k <= kSamples * kStepsASample; ++k) {
      information.Add(FromSeconds(k * kCourseStep_s), StateOf(arm, course[k]));
      if (k > kWarm * kStepsASample && k % (kEverySamples * kStepsASample) == 0) {
        information.Keep();
      }
    }
    const std::vector<Figure> figures = information.Figures();
    moments += static_cast<int>(figures[0].at.size());
    for (const Figure& figure : figures) {
      for (const double sigma : figure.at) squares[NameOf(figure.id)] += sigma * sigma;
    }
  }
  for (auto& [name, sum] : squares) sum = std::sqrt(sum / moments);
  return squares;
}

Deviations Observed(const Arm& arm, const std::vector<SensorDescription>& rig, int seeds) {
  Deviations squares;
  int moments = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const auto course = DrawCourse(arm, LawOf(arm), kSamples * kStepsASample, seed);
    const ArmSamples samples = SamplesOf(arm, rig, course, seed);
    // A unit's first sample does not know the previous velocity.
    ArmFilter filter(arm, rig, LawOf(arm), course[kStepsASample], 3 * kDeg, seed);
    for (int m = 2; m <= kSamples; ++m) {
      filter.Step(samples.moments[m]);
      if (m <= kWarm || m % kEverySamples != 0) continue;
      const Eigen::VectorXd truth = course[m * kStepsASample].c;
      const Eigen::VectorXd estimate = filter.state().head(arm.coordinates());
      const Vec3 q = (estimate - truth).tail<3>() / kDeg;
      squares["state/slew/sigma_deg"] += q[0] * q[0];
      squares["state/boom/sigma_deg"] += q[1] * q[1];
      squares["state/arm/sigma_deg"] += q[2] * q[2];
      const double heading_deg =
          std::remainder(HeadingOf(arm, estimate) - HeadingOf(arm, truth), 2 * kPi) / kDeg;
      squares["state/heading/sigma_deg"] += heading_deg * heading_deg;
      ++moments;
    }
  }
  for (auto& [name, sum] : squares) sum = std::sqrt(sum / moments);
  return squares;
}

// Errors of a run are correlated over the relevant seconds, as biases are. Each run gives at least
// one independent error. The deviation over N runs thus has a relative standard error of at most 1
// / sqrt(2 N): 9 % for 60. 30 % is three times that.
constexpr int kSeeds = 60;

void ExpectAlike(const Deviations& predicted, const Deviations& observed) {
  for (const auto& [name, sigma_deg] : observed) {
    ASSERT_TRUE(predicted.contains(name)) << name;

    EXPECT_GT(predicted.at(name), sigma_deg / 1.3) << name;
    EXPECT_LT(predicted.at(name), sigma_deg * 1.3) << name;
  }
}

TEST(JointInformation, SaysHowFarAFilterOfUnitsAndEncodersErrsOnAFixedBase) {
  const Arm arm{.fixed_base = true};
  const std::vector<SensorDescription> rig = {
      SlewEncoder(), ImuOn("boom", MakePose({1.0, 0.07, 0.6}, 0.1, -0.3, 0.2)),
      ImuOn("arm", MakePose({0.2, 0.07, 0.14}, 0, 0.4, -0.5))};
  ExpectAlike(Predicted(arm, rig, 6), Observed(arm, rig, kSeeds));
}

TEST(JointInformation, SaysHowFarAFilterErrsOnAMachineThatMovesAndHasTwoAntennas) {
  const Arm arm{.fixed_base = false};
  const std::vector<SensorDescription> rig = {
      ImuOn("upper", MakePose({0.15, -0.3, 0.12}, 0, 0, 0.3)),
      ImuOn("boom", MakePose({1.0, 0.07, 0.6}, 0.1, -0.3, 0.2)),
      ImuOn("arm", MakePose({0.2, 0.07, 0.14}, 0, 0.4, -0.5)),
      SlewEncoder(),
      Antenna("left", {-0.95, 0.55, 1.25}),
      Antenna("right", {-0.95, -0.55, 1.25})};
  ExpectAlike(Predicted(arm, rig, 6), Observed(arm, rig, kSeeds));
}

/// Initial figures of an arm at rest in the pose `c`.
Deviations AtRest(const Arm& arm, const std::vector<SensorDescription>& rig,
                  const Eigen::VectorXd& c, std::vector<std::string>* warnings = nullptr) {
  const MachineModel model = arm.Model();
  JointInformation information(model, 1, rig);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(c.size());
  information.Add(0, StateOf(arm, {c, none, none}));
  information.Keep();
  Deviations at_rest;
  for (const Figure& figure : information.Figures()) at_rest[NameOf(figure.id)] = figure.at.at(0);
  if (warnings) *warnings = information.Warnings();
  return at_rest;
}

TEST(JointInformation, ABiasedAccelerometerAtRestTellsAPitchToBiasOverGravity) {
  // The boom lies level, with the unit's axes along it. A small pitch p adds g p to the axis along
  // the boom, like a bias; they are indistinguishable: b / g = 0.292 deg.
  const Arm arm{.fixed_base = true};
  Eigen::VectorXd c = arm.Start();
  c[1] = 0;
  const Deviations at_rest = AtRest(arm, {ImuOn("boom", MakePose({1.0, 0.07, 0.6}))}, c);
  EXPECT_NEAR(at_rest.at("state/boom/sigma_deg"), 0.05 / kStandardGravity_mps2 / kDeg, 0.01);
}

TEST(JointInformation, WhatNothingObservesIsKnownAsWellAsItsTravelSaysAndNamed) {
  // A unit observes neither a turn about the vertical nor motion beyond it. The deviation of a
  // uniform value is the interval's length / sqrt(12).
  const Arm arm{.fixed_base = true};
  std::vector<std::string> warnings;
  const Deviations at_rest =
      AtRest(arm, {ImuOn("boom", MakePose({1.0, 0.07, 0.6}))}, arm.Start(), &warnings);
  EXPECT_NEAR(at_rest.at("state/slew/sigma_deg"), 360 / std::sqrt(12.0), 1e-9);
  EXPECT_NEAR(at_rest.at("state/arm/sigma_deg"), 20 / std::sqrt(12.0), 1e-9);
  EXPECT_LT(at_rest.at("state/boom/sigma_deg"), 0.5);
  // A single line for all of them, so that it hides no other warning.
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].starts_with("state/: ")) << warnings[0];
  for (const char* unknown : {" slew (", ", arm (", ", heading (", ", heading_of_pair ("}) {
    EXPECT_NE(warnings[0].find(unknown), std::string::npos) << unknown << warnings[0];
  }
  EXPECT_EQ(warnings[0].find("boom"), std::string::npos) << warnings[0];
}

TEST(JointInformation, AJointThatSlidesIsKnownInMetres) {
  const Arm arm{.fixed_base = true};
  MachineModel model = arm.Model();
  model.joints[2].type = JointType::kPrismatic;
  model.joints[2].lower_rad = -0.4;
  model.joints[2].upper_rad = 0.8;
  SensorDescription encoder = SlewEncoder();
  auto& axes = std::get<EncoderModel>(encoder.model);
  axes.joints = {"arm"};
  axes.resolution_m = 0.003;
  axes.noise_m = 0.002;
  for (const bool measured : {false, true}) {
    JointInformation information(
        model, 1, measured ? std::vector{encoder} : std::vector<SensorDescription>{});
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    information.Add(0, StateOf(arm, {arm.Start(), none, none}));
    information.Keep();
    const Figure slide = information.Figures().at(2);
    EXPECT_EQ(NameOf(slide.id), "state/arm/sigma_m");
    EXPECT_EQ(UnitOf(slide.id.measure), "m");
    if (measured) {
      // One sample is off by 2 mm and 3 / sqrt(12) mm; the last of them counts in full.
      EXPECT_LT(slide.at[0], std::hypot(0.002, 0.003 / std::sqrt(12.0)));
      EXPECT_GT(slide.at[0], 1e-4);
    } else {
      EXPECT_NEAR(slide.at[0], 1.2 / std::sqrt(12.0), 1e-9);
    }
  }
}

TEST(JointInformation, TwoAntennasTellTheHeadingByTheirDistance) {
  // Each end of the baseline errs by sigma across it, the heading by sqrt(2) sigma / d. Errors that
  // last for hours do not average out; the white noise of 1 mm over 10 s falls to a tenth. The
  // root's tilt of at most 0.06 rad shortens d by less than 0.2 %.
  const Arm arm{.fixed_base = false};
  for (const double distance_m : {0.6, 1.1, 2.0}) {
    SensorDescription left = Antenna("left", {-0.95, 0.5 * distance_m, 1.25});
    SensorDescription right = Antenna("right", {-0.95, -0.5 * distance_m, 1.25});
    for (SensorDescription* antenna : {&left, &right}) {
      auto& model = std::get<GnssModel>(antenna->model);
      model.correlation_time_s = 1e5;
      model.white_horizontal_m = model.white_vertical_m = 0.001;
    }
    const Deviations at_rest = AtRest(
        arm, {left, right, ImuOn("upper", MakePose({0.15, -0.3, 0.12}, 0, 0, 0.3))}, arm.Start());
    const double by_slow_deg = std::sqrt(2.0) * 0.007 / distance_m / kDeg;
    const double by_both_deg = std::sqrt(2.0 * (0.007 * 0.007 + 1e-6)) / distance_m / kDeg;
    EXPECT_NEAR(at_rest.at("state/heading/sigma_deg") / by_slow_deg, 1, 0.1) << distance_m;
    EXPECT_NEAR(at_rest.at("state/heading_of_pair/sigma_deg") / by_both_deg, 1, 0.002);
    // The rule of thumb of such pairs, 0.6 deg over the distance in metres.
    EXPECT_NEAR(at_rest.at("state/heading_of_pair/sigma_deg") * distance_m, 0.6, 0.1);
  }
}

TEST(JointInformation, AnEncoderOfAJointTellsIt) {
  // Alone, an encoder at 10 Hz improves with each sample while the joint does not move on. It is
  // better than one sample, 0.33 deg, by at most the square root of the samples within the joint's
  // response, 0.3 s.
  const Arm arm{.fixed_base = true};
  const double slew_deg = AtRest(arm, {SlewEncoder()}, arm.Start()).at("state/slew/sigma_deg");
  const double sample_deg = std::hypot(0.3, 0.5 / std::sqrt(12.0));
  EXPECT_LT(slew_deg, sample_deg);
  EXPECT_GT(slew_deg, sample_deg / std::sqrt(3.0));
}

}  // namespace
}  // namespace tera
