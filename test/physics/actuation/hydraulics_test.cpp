#include "physics/actuation/hydraulics.h"

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

// Bore 100 mm, rod 60 mm: pi/4 (0.1^2), and that minus pi/4 (0.06^2).
constexpr double kHead_m2 = 7.853982e-3, kRod_m2 = 5.026548e-3;

MachineRun CylinderArm(const std::vector<std::string>& overrides = {}) {
  return MachineRun(MachineFromText(kCylinderArm, overrides),
                    MakePose(Vec3(4, -1, 0.3), 0, 0, 2.0));
}

TEST(Hydraulics, AreasAreThoseOfBoreAndRod) {
  const MachineModel model = MachineFromText(kCylinderArm);
  EXPECT_NEAR(HeadArea_m2(model.cylinders[0]), kHead_m2, 1e-9);
  EXPECT_NEAR(RodArea_m2(model.cylinders[0]), kRod_m2, 1e-9);
}

TEST(Hydraulics, OilTakenIsTheVolumeThatThePistonSweeps) {
  const MachineModel model =
      MachineFromText(kCylinderArm, {"cylinders.ram.count=2", "cylinders.ram.spacing_m=0.3"});
  const double step_rad = 0.02, from_rad = 0.3;
  const double shorter_m = ReachOf(model, model.cylinders[0], from_rad - step_rad / 2).length_m -
                           ReachOf(model, model.cylinders[0], from_rad + step_rad / 2).length_m;
  // Raising pulls the rods in.
  EXPECT_NEAR(CylinderDisplacement_m3prad(model, 0, from_rad, +1) * step_rad,
              2 * kRod_m2 * shorter_m, 1e-4 * kRod_m2 * shorter_m);
  EXPECT_NEAR(CylinderDisplacement_m3prad(model, 0, from_rad, -1) * step_rad,
              2 * kHead_m2 * shorter_m, 1e-4 * kHead_m2 * shorter_m);
}

TEST(Hydraulics, RetractionIsFasterByTheAreaRatioAtEqualFlow) {
  const MachineModel model = MachineFromText(kCylinderArm);
  const double flow_m3ps = 5e-4;
  const double in_radps = flow_m3ps / CylinderDisplacement_m3prad(model, 0, 0.1, +1);
  const double out_radps = flow_m3ps / CylinderDisplacement_m3prad(model, 0, 0.1, -1);
  EXPECT_NEAR(in_radps / out_radps, 1.5625, 1e-9);  // 1 / (1 - 0.6^2)
}

/// Rates of a tb235's cylinder of `joint` over a second of full lever, with a pump of 2e-4 m3/s and
/// without weight.
std::vector<double> RatesAtLittleFlow_mps(const std::string& joint, double lever,
                                          const std::string& effects) {
  MachineModel model = ShippedMachine("tb235", {"fixed_base=true"});
  for (Pump& pump : model.pumps) pump.max_flow_m3ps = 2e-4;
  model = WithEffects(model,
                      "{pump_1: {flow_sharing: {}}, pump_2: {flow_sharing: {}}, " + effects + "}");
  MachinePlacement placement = PlaceAtStart(model, MakePose(Vec3(3, 1, 0), 0, 0, 0.7));
  placement.q_rad[model.JointIndex("boom")] = 20 * kDeg;
  placement.q_rad[model.JointIndex("arm")] = -80 * kDeg;
  placement.q_rad[model.JointIndex("bucket")] = 10 * kDeg;
  MachineRun run(placement, 0.0);
  const auto k =
      static_cast<std::size_t>(std::find_if(model.levers.begin(), model.levers.end(),
                                            [&](const Lever& l) { return l.name == joint; }) -
                               model.levers.begin());
  run.input.levers[k] = lever;
  const auto cylinder = static_cast<std::size_t>(
      std::find_if(model.cylinders.begin(), model.cylinders.end(),
                   [&](const Cylinder& c) { return c.joint == model.JointIndex(joint); }) -
      model.cylinders.begin());
  std::vector<double> rates_mps;
  for (int i = 0; i < 10; ++i) {
    run.StepFor(0.1);
    rates_mps.push_back(run.state().cylinders[cylinder].rate_mps);
  }
  return rates_mps;
}

TEST(Hydraulics, APumpsFlowDividedByTheAreaIsTheRateOfTheRod) {
  // Bores and rods of tb235.yaml: 80/45 mm twice, 70/40 mm.
  struct Case {
    std::string joint;
    double bore_m, rod_m;
  };
  for (const Case& c :
       {Case{"boom", 0.080, 0.045}, {"arm", 0.080, 0.045}, {"bucket", 0.070, 0.040}}) {
    const double head_m2 = kPi / 4 * c.bore_m * c.bore_m;
    const double rod_m2 = head_m2 - kPi / 4 * c.rod_m * c.rod_m;
    // Steady joints, and joints whose cylinders are steady: the same oil.
    for (const std::string& effects :
         {c.joint + ": {}", c.joint + ": {cylinder_lever: {reference_rad: -0.55}}"}) {
      double out_mps = 0, in_mps = 0;
      for (const double lever : {1.0, -1.0}) {
        for (const double rate_mps : RatesAtLittleFlow_mps(c.joint, lever, effects)) {
          const double expected_mps = rate_mps > 0 ? 2e-4 / head_m2 : -2e-4 / rod_m2;
          EXPECT_NEAR(rate_mps, expected_mps, 2e-3 * std::abs(expected_mps)) << effects << lever;
          (rate_mps > 0 ? out_mps : in_mps) = rate_mps;
        }
      }
      EXPECT_NEAR(-in_mps / out_mps, head_m2 / rod_m2, 0.005) << effects;
    }
  }
}

TEST(Hydraulics, AHeldArmsWeightIsThePressureAroundTheRod) {
  MachineRun run =
      CylinderArm({"links.hook.mass_kg=1e-6", "links.hook.inertia_kgm2=[1e-9, 1e-9, 1e-9]"});
  run.StepFor(0.5);
  const CylinderState& ram = run.state().cylinders[0];
  // 20 kg * 9.81 m/s2 * 0.8 m * cos(14.25 deg) = 152.13 N m at an arm of 0.466673 m: a pull of
  // 325.99 N, with the head side at the return pressure of 0.2 MPa.
  EXPECT_NEAR(ram.force_n, -325.99, 0.05);
  EXPECT_NEAR(ram.head_pressure_pa, 0.2e6, 1);
  EXPECT_NEAR(ram.rod_pressure_pa, 0.2e6 * 1.5625 + 325.99 / kRod_m2, 20);
  EXPECT_NEAR(ram.length_m, 1.392839, 1e-5);
  EXPECT_NEAR(ram.rate_mps, 0, 1e-6);
}

TEST(Hydraulics, BothPressuresBalanceTheForceAndNeitherFallsBelowTheReturnLine) {
  MachineRun run = CylinderArm();
  run.input.levers[0] = 1;
  double most_n = 0, least_n = 0;
  for (int i = 0; i < 2000; ++i) {
    run.Step();
    if (i == 700) run.input.levers[0] = -1;
    if (i == 1400) run.input.levers[0] = 1;
    const CylinderState& ram = run.state().cylinders[0];
    most_n = std::max(most_n, ram.force_n);
    least_n = std::min(least_n, ram.force_n);
    EXPECT_NEAR(ram.head_pressure_pa * kHead_m2 - ram.rod_pressure_pa * kRod_m2, ram.force_n,
                1e-3 + 1e-6 * std::abs(ram.force_n));
    EXPECT_NEAR(std::min(ram.head_pressure_pa, ram.rod_pressure_pa), 0.2e6, 1e-3);
  }
  EXPECT_GT(most_n, 500);
  EXPECT_LT(least_n, -500);
}

TEST(Hydraulics, AStalledCylinderPullsWithReliefPressureOnTheRodSide) {
  // The arm is too heavy: 2000 kg hang at 0.8 m, and the relief pressure holds only part.
  MachineRun run = CylinderArm({"links.arm.mass_kg=2000", "hydraulics.relief_pa=2.0e6",
                                "cylinders.ram.count=2", "cylinders.ram.spacing_m=0.2"});
  run.input.levers[0] = 1;
  run.Step(5);
  const MachineState& state = run.state();
  const CylinderState& ram = state.cylinders[0];
  EXPECT_LT(state.qd_radps[0], 0);
  EXPECT_NEAR(ram.rod_pressure_pa, 2.0e6, 1);
  EXPECT_NEAR(ram.head_pressure_pa, 0.2e6, 1);
  const double pull_n = 2.0e6 * kRod_m2 - 0.2e6 * kHead_m2;
  EXPECT_NEAR(ram.force_n, -pull_n, 1e-4 * pull_n);
  EXPECT_NEAR(state.effort_nm[0], 2 * pull_n * 0.466673, 1e-3 * pull_n);
}

TEST(Hydraulics, PushingAndPullingHaveTheLimitsOfTheirAreas) {
  const MachineModel model = MachineFromText(kCylinderArm);
  const EffortLimits limits = ReliefEffort(model, 0, 14.2500327 * kDeg);
  EXPECT_NEAR(limits.positive_nm, 0.466673 * (20e6 * kRod_m2 - 0.2e6 * kHead_m2), 1);
  EXPECT_NEAR(limits.negative_nm, 0.466673 * (20e6 * kHead_m2 - 0.2e6 * kRod_m2), 1);
}

TEST(Hydraulics, CylindersOfOneJointShareItsEffortByTheirAreas) {
  const std::string second =
      "cylinders.small={bore_m: 0.05, rod_diameter_m: 0.03, relief_pa: 20.0e6, barrel: {link: "
      "post, "
      "pin_m: [-0.0598076, -0.05, 1.5]}, rod: {link: arm, pin_m: [1.2, 0, 0.5]}}";
  MachineRun run = CylinderArm({second, "hydraulics.return_pressure_pa=0"});
  run.StepFor(0.3);
  const auto& cylinders = run.state().cylinders;
  ASSERT_EQ(cylinders.size(), 2u);
  EXPECT_NEAR(cylinders[0].force_n / cylinders[1].force_n, 4.0, 1e-6);
  EXPECT_NEAR(cylinders[0].rod_pressure_pa, cylinders[1].rod_pressure_pa, 1);
}

TEST(Hydraulics, EveryHingeOfTheExcavatorHasItsCylinder) {
  const MachineModel model = ShippedMachine("tb235");
  const auto cylinder = [&](const char* joint) {
    const auto found =
        std::find_if(model.cylinders.begin(), model.cylinders.end(),
                     [&](const Cylinder& c) { return c.joint == model.JointIndex(joint); });
    EXPECT_NE(found, model.cylinders.end()) << joint;
    return *found;
  };
  for (const char* joint : {"boom", "arm", "bucket", "swing", "blade"}) {
    EXPECT_GT(cylinder(joint).bore_m, 0) << joint;
  }
  // Pins 0.2915 and 0.4386 m from the blade's hinge, 133.6 deg apart when it is level; raising the
  // blade pulls the rod in. Pins 0.7762 and 0.1604 m from the post's, 79.9 deg apart straight
  // ahead.
  const CylinderReach blade = ReachOf(model, cylinder("blade"), 0);
  EXPECT_NEAR(blade.length_m, 0.67365, 1e-5);
  EXPECT_NEAR(blade.arm_m, -0.13746, 1e-5);
  const CylinderReach swing = ReachOf(model, cylinder("swing"), 0);
  EXPECT_NEAR(swing.length_m, 0.76466, 1e-5);
  EXPECT_NEAR(swing.arm_m, 0.16035, 1e-5);
}

TEST(Hydraulics, TheBladeCanLiftTheExcavatorsFront) {
  // About the rear ends of the tracks, with the tools stowed: at most half of the weight is at the
  // blade's edge. The edge is 2.3 m from there, and the weight at most 1.1 m.
  const MachineModel model = ShippedMachine("tb235");
  const int joint = model.JointIndex("blade");
  for (const double q_deg : {-20.0, -10.0, 0.0}) {
    const double q_rad = q_deg * kDeg;
    const double edge_m = 0.55 * std::cos(q_rad) + 0.30 * std::sin(q_rad);
    EXPECT_GT(ReliefEffort(model, joint, q_rad).negative_nm, edge_m * 0.5 * 3500 * kGravity_mps2)
        << q_deg;
  }
}

TEST(Hydraulics, WorkOfTheCylindersIsWorkOfTheirJoints) {
  const MachineModel model = ShippedMachine("tb235", {"fixed_base=true"});
  MachineRun run(model, MakePose(Vec3(1, 2, 0), 0, 0, 0.7));
  for (const char* lever : {"boom", "arm", "bucket", "swing", "blade"}) {
    run.input.levers[model.LeverIndex(lever)] = 0.5;
  }
  const std::size_t cylinders = model.cylinders.size();
  std::vector<double> piston_j(cylinders, 0), joint_j(cylinders, 0);
  for (int i = 0; i < 800; ++i) {
    const MachineState before = run.state();
    run.Step();
    for (std::size_t c = 0; c < cylinders; ++c) {
      const int joint = model.cylinders[c].joint;
      const CylinderState& now = run.state().cylinders[c];
      piston_j[c] += now.force_n * (now.length_m - before.cylinders[c].length_m);
      joint_j[c] += run.state().effort_nm[joint] * (run.state().q_rad[joint] - before.q_rad[joint]);
    }
  }
  for (std::size_t c = 0; c < cylinders; ++c) {
    EXPECT_GT(std::abs(joint_j[c]), 1) << model.cylinders[c].name;
    EXPECT_NEAR(piston_j[c], joint_j[c], 2e-3 * std::abs(joint_j[c])) << model.cylinders[c].name;
  }
}

TEST(Hydraulics, ACylinderDrivesItsJointInPlaceOfMaxEffort) {
  const MachineModel model = ShippedMachine("tb235");
  const Joint& bucket = model.joints[model.JointIndex("bucket")];
  EXPECT_GT(bucket.max_effort_nm, 5e3);
  EXPECT_LT(bucket.max_effort_nm, 25e3);
  EXPECT_GT(bucket.displacement_m3prad, 0);
  EXPECT_THAT(FaultsOf(kCylinderArm, {"joints.lift.max_effort_nm=500"}), HasFault(kInconsistent));
  EXPECT_THAT(FaultsOf(kCylinderArm, {"joints.lift.displacement_m3prad=0.01"}),
              HasFault(kInconsistent));
}

TEST(Hydraulics, PumpsKnowWhatTheyFeed) {
  const MachineModel model =
      MachineFromText(kCylinderArm, {"pumps.main={max_flow_m3ps: 1.0e-3, feeds: [lift, swivel]}",
                                     "joints.swivel.displacement_m3prad=2.0e-5"});
  ASSERT_EQ(model.pumps.size(), 1u);
  EXPECT_EQ(model.pumps[0].name, "main");
  EXPECT_EQ(model.pumps[0].joints, (std::vector<int>{0, 1}));
  EXPECT_DOUBLE_EQ(model.pumps[0].max_flow_m3ps, 1e-3);
  EXPECT_DOUBLE_EQ(model.joints[1].displacement_m3prad, 2e-5);
}

TEST(Hydraulics, FaultsSayWhatDoesNotFit) {
  const auto faults = [](const std::string& override) {
    return FaultsOf(kCylinderArm, {override});
  };
  EXPECT_THAT(faults("cylinders.ram.rod_diameter_m=0.1"),
              HasFault(kInconsistent, "rod_diameter_m"));
  EXPECT_THAT(faults("cylinders.ram.bore_m=-0.1"), HasFault(kOutOfRange, "cylinders.ram.bore_m"));
  EXPECT_THAT(faults("hydraulics.return_pressure_pa=15.0e6"), HasFault(kOutOfRange, "relief_pa"));
  std::string without_relief = kCylinderArm;
  without_relief.replace(without_relief.find("relief_pa: 20.0e6, "), 19, "");
  EXPECT_THAT(FaultsOf(without_relief), HasFault(kMissing, "cylinders.ram.relief_pa"));
  EXPECT_THAT(faults("joints.lift.limits_deg=[-40, 88]"), HasFault(kInconsistent, "cylinders.ram"));
  EXPECT_THAT(faults("cylinders.ram.count=0"), HasFault(kOutOfRange, "cylinders.ram.count"));
  EXPECT_THAT(faults("cylinders.ram.count=2"), HasFault(kMissing, "cylinders.ram.spacing_m"));
  EXPECT_THAT(faults("cylinders.ram.stroke_m=2"), HasFault(kUnknown, "stroke_m"));
  EXPECT_THAT(faults("pumps.main={max_flow_m3ps: 1.0e-3, feeds: [lifd]}"),
              HasFault(kNoSuchName, "pumps.main.feeds"));
  EXPECT_THAT(faults("pumps.main={max_flow_m3ps: 0, feeds: [lift]}"),
              HasFault(kOutOfRange, "pumps.main.max_flow_m3ps"));
  EXPECT_THAT(faults("pumps.main={max_flow_m3ps: 1.0e-3, feeds: [swivel]}"), HasFaultAt("pumps"));
}

}  // namespace
}  // namespace tera
