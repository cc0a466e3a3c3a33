#include "sim/operators/planar_arm.h"

#include <gtest/gtest.h>

#include "core/config/config.h"
#include "core/units.h"

namespace tera {
namespace {

MachineModel ReadTb235() {
  const Config config = Config::FromFile("config/machines/tb235.yaml");
  MachineModel model = ReadMachine(config.root());
  config.Finish();
  return model;
}

PlanarArm ArmOf(const MachineModel& model) {
  return PlanarArm(model,
                   {model.JointIndex("slew"), model.JointIndex("boom"), model.JointIndex("arm"),
                    model.JointIndex("bucket")},
                   0);
}

TEST(PlanarArm, ForwardAgreesWithTheJointTree) {
  const MachineModel model = ReadTb235();
  std::vector<double> q_rad(model.joints.size(), 0.0);
  q_rad[model.JointIndex("slew")] = 0.7;
  q_rad[model.JointIndex("boom")] = 0.6;
  q_rad[model.JointIndex("arm")] = -1.9;
  q_rad[model.JointIndex("bucket")] = -0.5;
  const Pose X_WB = MakePose(Vec3(3, -2, 0.5), 0, 0, 0.4);
  const std::vector<Pose> links = ForwardKinematics(model, X_WB, q_rad);
  const Vec3 tip_U = links[model.LinkIndex("upper")].inverse() *
                     (links[model.LinkIndex("bucket")] * model.frames[0].X_BF.translation());
  const PlanarArm::Tip tip = ArmOf(model).Forward({0.6, -1.9, -0.5});
  EXPECT_NEAR(tip.r_m, tip_U.x(), 1e-9);
  EXPECT_NEAR(tip.z_m, tip_U.z(), 1e-9);
  EXPECT_NEAR(tip_U.y(), 0.0, 1e-9);
}

TEST(PlanarArm, InverseReachesTheTargetItWasGiven) {
  const PlanarArm arm = ArmOf(ReadTb235());
  for (const double r_m : {2.2, 3.3, 4.2}) {
    for (const double z_m : {-1.5, 0.0, 1.4}) {
      const auto angles = arm.Inverse({r_m, z_m, -100 * kDeg});
      ASSERT_TRUE(angles.has_value()) << r_m << " " << z_m;
      const PlanarArm::Tip tip = arm.Forward(*angles);
      EXPECT_NEAR(tip.r_m, r_m, 1e-9);
      EXPECT_NEAR(tip.z_m, z_m, 1e-9);
      EXPECT_NEAR(tip.pitch_rad, -100 * kDeg, 1e-9);
      EXPECT_LT(angles->arm_rad, 0.0);  // elbow up
    }
  }
}

TEST(PlanarArm, SaysWhenATargetIsOutOfReach) {
  // Foot at 0.8 m; boom 2.5 + arm 1.545 + bucket 0.78 m stretched out reach 5.6 m at most.
  EXPECT_FALSE(ArmOf(ReadTb235()).Inverse({5.7, 0.3, 0.0}).has_value());
  EXPECT_TRUE(ArmOf(ReadTb235()).Inverse({5.5, 0.3, 0.0}).has_value());
}

}  // namespace
}  // namespace tera
