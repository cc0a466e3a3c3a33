#include "physics/hydraulics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics/actuation_mechanisms.h"
#include "physics/cylinder_fixture.h"
#include "physics/machine_fixture.h"
#include "physics/slots/load_friction.h"

namespace tera {
namespace {

// Bore 100 mm, rod 60 mm: pi/4 (0.1^2), and that less pi/4 (0.06^2).
constexpr double kHead_m2 = 7.853982e-3, kRod_m2 = 5.026548e-3;

MachineRun CylinderArm(const std::vector<std::string>& overrides = {}) {
  return MachineRun(MachineFromText(kCylinderArm, overrides),
                    MakePose(Vec3(4, -1, 0.3), 0, 0, 2.0));
}

/// The compact excavator bolted to the ground, with a payload at (0.4, 0, 0.2) m of its bucket.
MachineModel LoadedExcavator(double payload_kg) {
  MachineModel model = ShippedMachine("tb235", {"fixed_base=true"});
  const auto table = ActuationMechanisms();
  const auto payload = std::find_if(table.begin(), table.end(),
                                    [](const Mechanism& m) { return m.id == "payload"; });
  model.effects.joints.resize(model.joints.size());
  model.effects.joints[model.JointIndex("bucket")] = {
      {.mechanism = &*payload, .values = {payload_kg, 0.4, 0.0, 0.2}}};
  return model;
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

TEST(Hydraulics, AHeldArmsWeightIsThePressureAroundTheRod) {
  MachineRun run =
      CylinderArm({"links.hook.mass_kg=1e-6", "links.hook.inertia_kgm2=[1e-9, 1e-9, 1e-9]"});
  run.StepFor(0.5);
  const CylinderState& ram = run.state().cylinders[0];
  // 20 kg * 9.81 m/s2 * 0.8 m * cos(14.25 deg) = 152.13 N m at an arm of 0.466673 m: 325.99 N
  // of pull, and the head side at the return pressure of 0.2 MPa.
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
  // The arm is too heavy: 2000 kg hang at 0.8 m, of which relief holds a part.
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

TEST(Hydraulics, WorkOfTheCylindersIsWorkOfTheirJoints) {
  const MachineModel model = ShippedMachine("tb235", {"fixed_base=true"});
  MachineRun run(model, MakePose(Vec3(1, 2, 0), 0, 0, 0.7));
  for (const char* lever : {"boom", "arm", "bucket"}) {
    run.input.levers[model.LeverIndex(lever)] = 0.5;
  }
  const std::size_t cylinders = model.cylinders.size();
  std::vector<double> piston_j(cylinders, 0), joint_j(cylinders, 0);
  for (int i = 0; i < 500; ++i) {
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

TEST(Hydraulics, TheBucketsTorqueIsWeightTimesDistanceOfItsPayload) {
  const auto held_nm = [](double payload_kg) {
    const MachineModel model = LoadedExcavator(payload_kg);
    MachineRun run(model);
    run.StepFor(1.0);
    return run.state().effort_nm[model.JointIndex("bucket")];
  };
  const double empty_nm = held_nm(0);
  // Boom 45, arm -110, bucket -40 - 45 deg: the bucket's x axis is at -150 deg, and the payload
  // 0.4 cos(-150 deg) - 0.2 sin(-150 deg) = -0.246410 m in front of the bucket's pin.
  for (const double payload_kg : {100.0, 200.0, 300.0, 400.0, 500.0}) {
    const double expected_nm = payload_kg * kGravity_mps2 * -0.246410;
    EXPECT_NEAR(held_nm(payload_kg) - empty_nm, expected_nm, 0.01 * std::abs(expected_nm));
  }
}

TEST(Hydraulics, ACylinderDrivesItsJointInPlaceOfMaxEffort) {
  const MachineModel model = ShippedMachine("tb235");
  const Joint& bucket = model.joints[model.JointIndex("bucket")];
  EXPECT_GT(bucket.max_effort_nm, 5e3);
  EXPECT_LT(bucket.max_effort_nm, 25e3);
  EXPECT_GT(bucket.displacement_m3prad, 0);
  EXPECT_THAT(FaultsOf(kCylinderArm, {"joints.lift.max_effort_nm=500"}),
              testing::HasSubstr("has it from bore, pressure and pins of cylinder 'ram'"));
  EXPECT_THAT(FaultsOf(kCylinderArm, {"joints.lift.displacement_m3prad=0.01"}),
              testing::HasSubstr("has it from bore, pressure and pins of cylinder 'ram'"));
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
  using ::testing::HasSubstr;
  const auto faults = [](const std::string& override) {
    return FaultsOf(kCylinderArm, {override});
  };
  EXPECT_THAT(faults("cylinders.ram.rod_diameter_m=0.1"),
              HasSubstr("does not fit the bore of 0.1 m"));
  EXPECT_THAT(faults("cylinders.ram.bore_m=-0.1"), HasSubstr("bore_m"));
  EXPECT_THAT(faults("hydraulics.return_pressure_pa=15.0e6"), HasSubstr("cannot pull"));
  std::string without_relief = kCylinderArm;
  without_relief.replace(without_relief.find("relief_pa: 20.0e6, "), 19, "");
  EXPECT_THAT(FaultsOf(without_relief), HasSubstr("cylinders.ram.relief_pa: missing"));
  EXPECT_THAT(faults("joints.lift.limits_deg=[-40, 88]"),
              HasSubstr("less than twice its shortest"));
  EXPECT_THAT(faults("cylinders.ram.count=0"), HasSubstr("count"));
  EXPECT_THAT(faults("cylinders.ram.count=2"), HasSubstr("spacing_m"));
  EXPECT_THAT(faults("cylinders.ram.stroke_m=2"), HasSubstr("stroke_m: unknown key"));
  EXPECT_THAT(faults("pumps.main={max_flow_m3ps: 1.0e-3, feeds: [lifd]}"),
              HasSubstr("'lifd' (did you mean 'lift'?)"));
  EXPECT_THAT(faults("pumps.main={max_flow_m3ps: 0, feeds: [lift]}"), HasSubstr("max_flow_m3ps"));
  EXPECT_THAT(faults("pumps.main={max_flow_m3ps: 1.0e-3, feeds: [swivel]}"),
              HasSubstr("pump 'main' feeds swivel, of which the oil taken is not known"));
}

TEST(Hydraulics, OilThickensInTheColdAsItsGradeDoes) {
  // ISO VG 46 (ISO 3448: 41.4 to 50.6 mm2/s at 40 C). Makers' sheets of mineral oils of this grade
  // with a viscosity index of 95 to 105 give 6.6 to 7.0 mm2/s at 100 C and 500 to 640 mm2/s at 0 C.
  EXPECT_NEAR(OilViscosity_cst(40), 46, 0.1);
  EXPECT_GT(OilViscosity_cst(100), 6.6);
  EXPECT_LT(OilViscosity_cst(100), 7.0);
  EXPECT_GT(OilViscosity_cst(0), 500);
  EXPECT_LT(OilViscosity_cst(0), 640);
}

}  // namespace
}  // namespace tera
