#include "physics/actuation/linkage.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/faults.h"
#include "physics/actuation/cylinder_fixture.h"
#include "physics/machine_fixture.h"

namespace tera {
namespace {

using enum FaultKind;

/// The crank turns about z, and the rocker's pin is 1 m to the side of its joint. A crank of 0.3 m,
/// a coupler of 1 m and a rocker of 0.3 m form a parallelogram.
const std::string kParallelogram = R"(
kind: parallelogram
fixed_base: true
links:
  post: {mass_kg: 50, inertia_kgm2: [1, 1, 1]}
  crank: {mass_kg: 2, inertia_kgm2: [0.1, 0.1, 0.1]}
joints:
  turn:
    type: revolute
    parent: post
    child: crank
    xyz_m: [0.4, -0.2, 0.7]
    axis: [0, 0, 1]
    limits_deg: [30, 150]
    max_rate_degps: 30
    max_effort_nm: 10
levers: [turn]
linkages:
  bars:
    rocker: {link: post, pin_m: [1.4, -0.2, 0.7], length_m: 0.3}
    coupler: {link: crank, pin_m: [0.3, 0, 0], length_m: 1.0}
    branch: negative
)";

std::vector<double> TravelOf(const Joint& joint) {
  std::vector<double> travel;
  for (int i = 0; i <= 200; ++i) {
    travel.push_back(joint.lower_rad + (joint.upper_rad - joint.lower_rad) * i / 200);
  }
  return travel;
}

TEST(Linkage, ACylindersLengthFollowsTheLawOfCosines) {
  const MachineModel model = MachineFromText(kCylinderArm);
  const Cylinder& ram = model.cylinders[0];
  // Angle between the pins 90 deg: sqrt(0.25 + 1.69) m, arm 0.5 * 1.3 / length. Raising shortens.
  const CylinderReach square = ReachOf(model, ram, 14.2500327 * kDeg);
  EXPECT_NEAR(square.length_m, 1.392839, 1e-6);
  EXPECT_NEAR(square.arm_m, -0.466673, 1e-6);
  // 60 deg: sqrt(0.25 + 1.69 - 0.65) m, arm 0.65 sin 60 / length.
  const CylinderReach sharp = ReachOf(model, ram, 44.2500327 * kDeg);
  EXPECT_NEAR(sharp.length_m, 1.135782, 1e-6);
  EXPECT_NEAR(sharp.arm_m, -0.495620, 1e-6);
}

TEST(Linkage, AParallelogramsRockerTurnsWithItsCrank) {
  const MachineModel model = MachineFromText(kParallelogram);
  for (const double q_rad : TravelOf(model.joints[0])) {
    const FourBarPose pose = PoseOf(model, model.linkages[0], q_rad);
    const Vec3 knee_P_m = pose.X_PR * Vec3(0.3, 0, 0);
    EXPECT_TRUE(knee_P_m.isApprox(
        Vec3(1.4 + 0.3 * std::cos(q_rad), -0.2 + 0.3 * std::sin(q_rad), 0.7), 1e-9))
        << q_rad / kDeg;
    EXPECT_TRUE(pose.X_PC.linear().col(0).isApprox(Vec3::UnitX(), 1e-9));
  }
}

TEST(Linkage, TheOtherBranchFoldsToTheOtherSide) {
  const MachineModel model = MachineFromText(kParallelogram, {"linkages.bars.branch=positive"});
  // With the crank at 90 deg, mirrored about the line between the pins, (-0.3, 1) to scale:
  const Vec3 knee_P_m = PoseOf(model, model.linkages[0], 90 * kDeg).X_PR * Vec3(0.3, 0, 0);
  const Vec3 a(1.4, -0.2, 0.7), b(0.4, 0.1, 0.7);
  EXPECT_NEAR((knee_P_m - a).norm(), 0.3, 1e-9);
  EXPECT_NEAR((knee_P_m - b).norm(), 1.0, 1e-9);
  EXPECT_LT(knee_P_m.y(), a.y());
}

/// Pins and lengths of a bucket's four-bar, from its machine's file.
struct BucketBars {
  const char* machine;
  Vec3 rocker_pin_m, coupler_pin_m;  ///< in the arm and in the bucket
  double rocker_m, coupler_m;
};

const BucketBars kBucketBars[] = {{"tb235", {1.30, 0, 0.02}, {-0.125, 0, 0.165}, 0.29, 0.30},
                                  {"excavator20t", {2.50, 0, 0.02}, {-0.06, 0, 0.455}, 0.66, 0.62}};

/// Largest gaps between the pins of rocker and arm, coupler and bucket, rocker and coupler.
double WorstGap_m(const MachineModel& model, const BucketBars& bars, const Pose& X_WArm,
                  const Pose& X_WBucket, double q_rad) {
  const FourBarPose pose = PoseOf(model, model.linkages[0], q_rad);
  const Pose X_WR = X_WArm * pose.X_PR, X_WC = X_WArm * pose.X_PC;
  return std::max({(X_WR.translation() - X_WArm * bars.rocker_pin_m).norm(),
                   (X_WC.translation() - X_WBucket * bars.coupler_pin_m).norm(),
                   (X_WR * Vec3(bars.rocker_m, 0, 0) - X_WC * Vec3(bars.coupler_m, 0, 0)).norm()});
}

constexpr double kMostGap_m = 1e-4;

TEST(Linkage, PinsOfTheExcavatorsFourBarsStayTogetherOverTheirTravel) {
  for (const BucketBars& bars : kBucketBars) {
    const MachineModel model = ShippedMachine(bars.machine);
    ASSERT_EQ(model.linkages.size(), 1u);
    const int arm = model.LinkIndex("arm"), bucket = model.LinkIndex("bucket");
    const int joint = model.JointIndex("bucket");
    std::vector<double> q_rad;
    for (const Joint& j : model.joints) q_rad.push_back(j.initial_rad);
    double worst_m = 0;
    for (const double q : TravelOf(model.joints[joint])) {
      q_rad[joint] = q;
      const auto links =
          ForwardKinematics(model, MakePose(Vec3(300, -200, 1), 0.1, -0.2, 2.0), q_rad);
      worst_m = std::max(worst_m, WorstGap_m(model, bars, links[arm], links[bucket], q));
    }
    EXPECT_LT(worst_m, kMostGap_m) << bars.machine;
    RecordProperty(std::string(bars.machine) + "_gap_m", fmt::format("{:.1e}", worst_m));
  }
}

TEST(Linkage, PinsOfTheExcavatorsFourBarsStayTogetherInMotion) {
  for (const BucketBars& bars : kBucketBars) {
    const MachineModel model = ShippedMachine(bars.machine, {"fixed_base=true"});
    const int arm = model.LinkIndex("arm"), bucket = model.LinkIndex("bucket");
    const int joint = model.JointIndex("bucket");
    MachineRun run(model, MakePose(Vec3(300, -200, 1), 0.1, -0.2, 2.0));
    double worst_m = 0, least_rad = 0, most_rad = 0;
    // To both end stops, with the boom and the slew moving.
    for (const double lever : {1.0, -1.0, 1.0}) {
      run.input.levers[model.LeverIndex("bucket")] = lever;
      run.input.levers[model.LeverIndex("boom")] = 0.3 * lever;
      run.input.levers[model.LeverIndex("slew")] = 0.5;
      for (int step = 0; step < 2500; ++step) {
        run.Step();
        const double q = run.state().q_rad[joint];
        const auto& links = run.state().links;
        worst_m =
            std::max(worst_m, WorstGap_m(model, bars, links[arm].X_WB, links[bucket].X_WB, q));
        least_rad = std::min(least_rad, q);
        most_rad = std::max(most_rad, q);
      }
    }
    EXPECT_NEAR(least_rad, model.joints[joint].lower_rad, 1e-3) << bars.machine;
    EXPECT_NEAR(most_rad, model.joints[joint].upper_rad, 1e-3) << bars.machine;
    EXPECT_LT(worst_m, kMostGap_m) << bars.machine;
    RecordProperty(std::string(bars.machine) + "_gap_m", fmt::format("{:.1e}", worst_m));
  }
}

TEST(Linkage, NoBarOfTheExcavatorsFourBarComesIntoLineWithTheNext) {
  const MachineModel model = ShippedMachine("tb235");
  const FourBar& linkage = model.linkages[0];
  const Joint& joint = model.joints[linkage.joint];
  const auto angle_deg = [](const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) / kDeg;
  };
  for (const double q : TravelOf(joint)) {
    const FourBarPose pose = PoseOf(model, linkage, q);
    const Vec3 rocker = pose.X_PR.linear().col(0), coupler = pose.X_PC.linear().col(0);
    const Vec3 ear = pose.X_PC.translation() - joint.X_PJ.translation();
    for (const double at_deg : {angle_deg(rocker, coupler), angle_deg(coupler, ear)}) {
      EXPECT_GT(at_deg, 29.0) << q / kDeg;
      EXPECT_LT(at_deg, 151.0) << q / kDeg;
    }
  }
}

TEST(Linkage, TheLeverArmIsTheChangeOfLength) {
  const double step_rad = 1e-5;
  for (const char* name : {"tb235", "excavator20t"}) {
    const MachineModel model = ShippedMachine(name);
    ASSERT_GE(model.cylinders.size(), 3u);
    for (const Cylinder& cylinder : model.cylinders) {
      for (const double q : TravelOf(model.joints[cylinder.joint])) {
        const double change_m = ReachOf(model, cylinder, q + step_rad).length_m -
                                ReachOf(model, cylinder, q - step_rad).length_m;
        EXPECT_NEAR(ReachOf(model, cylinder, q).arm_m, change_m / (2 * step_rad), 1e-8)
            << cylinder.name << " at " << q / kDeg;
      }
    }
  }
}

TEST(Linkage, APinBehindAFixedJointMovesWithTheLinkThatItIsFixedTo) {
  const std::string eye = "links.eye={mass_kg: 0.5, inertia_kgm2: [0.01, 0.01, 0.01]}";
  const std::string weld =
      "joints.weld={type: fixed, parent: arm, child: eye, xyz_m: [1.0, 0.2, 0.1], rpy_deg: [0, 0, "
      "90]}";
  const MachineModel plain = MachineFromText(kCylinderArm);
  // (0.2, -0.2, 0.4) of the arm beyond the eye's origin, turned back by 90 deg about z.
  const MachineModel welded = MachineFromText(
      kCylinderArm,
      {eye, weld, "cylinders.ram.rod.link=eye", "cylinders.ram.rod.pin_m=[-0.2, -0.2, 0.4]"});
  EXPECT_NEAR(ReachOf(plain, plain.cylinders[0], 0.3).length_m,
              ReachOf(welded, welded.cylinders[0], 0.3).length_m, 1e-12);
}

TEST(Linkage, ACylinderMayBeTurnedRound) {
  const MachineModel plain = MachineFromText(kCylinderArm);
  const MachineModel turned = MachineFromText(
      kCylinderArm,
      {"cylinders.ram.barrel.link=arm", "cylinders.ram.barrel.pin_m=[1.2, 0, 0.5]",
       "cylinders.ram.rod.link=post", "cylinders.ram.rod.pin_m=[-0.0598076, -0.05, 1.5]"});
  const CylinderReach a = ReachOf(plain, plain.cylinders[0], 0.3);
  const CylinderReach b = ReachOf(turned, turned.cylinders[0], 0.3);
  EXPECT_NEAR(a.length_m, b.length_m, 1e-12);
  EXPECT_NEAR(a.arm_m, b.arm_m, 1e-12);
}

TEST(Linkage, FaultsSayWhatDoesNotFit) {
  const auto faults = [](const std::string& yaml, const std::vector<std::string>& overrides) {
    return FaultsOf(yaml, overrides);
  };
  EXPECT_THAT(faults(kParallelogram, {"linkages.bars.coupler.length_m=0.2"}),
              HasFault(kInconsistent, "linkages.bars"));
  EXPECT_THAT(faults(kParallelogram, {"linkages.bars.coupler.length_m=0.6"}),
              HasFault(kInconsistent, "linkages.bars"));
  EXPECT_THAT(faults(kParallelogram, {"linkages.bars.rocker.pin_m=[1.4, -0.2, 0.72]"}),
              HasFault(kInconsistent));
  EXPECT_THAT(faults(kParallelogram, {"linkages.bars.branch=upwards"}),
              HasFault(kNoSuchName, "linkages.bars.branch"));
  EXPECT_THAT(faults(kParallelogram, {"linkages.bars.coupler.link=post"}), HasFault(kInconsistent));
  EXPECT_THAT(faults(kCylinderArm, {"cylinders.ram.rod.link=post"}), HasFault(kInconsistent));
  EXPECT_THAT(faults(kCylinderArm, {"cylinders.ram.rod.link=hook"}),
              HasFault(kInconsistent, "cylinders.ram"));
  EXPECT_THAT(faults(kCylinderArm, {"cylinders.ram.rod={linkage: bar}"}),
              HasFault(kNoSuchName, "linkage"));
  EXPECT_THAT(faults(kCylinderArm, {"joints.lift.limits_deg=[-60, 110]"}), HasFault(kInconsistent));
  EXPECT_THAT(faults(kCylinderArm, {"cylinders.ram.barrel.pin_m=[1.1, 0.6, 1.9]"}),
              HasFault(kInconsistent));
}

}  // namespace
}  // namespace tera
