#include "physics/actuation/actuation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics/actuation/actuation_faults.h"
#include "physics/actuation/cylinder_fixture.h"
#include "physics/machine_fixture.h"

namespace tera {
namespace {

/// The lift arm at `angle_deg`, its lever at rest.
MachineRun LiftArmAt(double angle_deg, const std::vector<std::string>& overrides = {}) {
  MachinePlacement placement =
      PlaceAtStart(MachineFromText(kLiftArm, overrides), MakePose(Vec3(4, -1, 0.3), 0, 0, 2.0));
  placement.q_rad = {angle_deg * kDeg};
  return MachineRun(placement);
}

TEST(Actuation, HoldingTorqueIsWeightTimesLeverArm) {
  MachineRun run = LiftArmAt(25);
  run.StepFor(0.5);
  const double expected_nm = 20 * kGravity_mps2 * 0.8 * std::cos(25 * kDeg);
  EXPECT_NEAR(run.state().effort_nm[0], expected_nm, 0.01 * expected_nm);
  EXPECT_NEAR(run.state().q_rad[0], 25 * kDeg, 1e-6);
}

TEST(Actuation, HoldingTorqueGrowsWithTheCarriedSoil) {
  MachineRun run = LiftArmAt(-20);
  for (const double mass_kg : {0.0, 30.0, 80.0}) {
    run.input.soil.shovel_load = {
        {.mass_kg = mass_kg, .com_B_m = Vec3(1.6, 0, -0.08), .volume_m3 = mass_kg / 1600}};
    run.StepFor(0.5);
    // The load's place, rotated down by 20 deg.
    const double arm_m = 1.6 * std::cos(20 * kDeg) - 0.08 * std::sin(20 * kDeg);
    const double expected_nm = kGravity_mps2 * (20 * 0.8 * std::cos(20 * kDeg) + mass_kg * arm_m);
    EXPECT_NEAR(run.state().effort_nm[0], expected_nm, 0.01 * expected_nm) << mass_kg;
    EXPECT_NEAR(run.state().q_rad[0], -20 * kDeg, 1e-6);
  }
}

TEST(Actuation, CarriedSoilAddsItsInertia) {
  // A weightless start from rest with a saturated motor: alpha = torque / inertia.
  const auto first_alpha = [](double mass_kg, double volume_m3) {
    MachinePlacement placement =
        PlaceAtStart(MachineFromText(kLiftArm, {"joints.lift.max_effort_nm=10"}), Pose::Identity());
    MachineRun run(placement, 0.0);
    run.input.levers = {1};
    run.input.soil.shovel_load = {
        {.mass_kg = mass_kg, .com_B_m = Vec3(1.6, 0, 0), .volume_m3 = volume_m3}};
    run.Step();
    return run.state().qd_radps[0] / kStep_s;
  };
  const double bare = 3.0 + 20 * 0.8 * 0.8;
  EXPECT_NEAR(first_alpha(0, 0), 10 / bare, 1e-9);
  EXPECT_NEAR(first_alpha(50, 0), 10 / (bare + 50 * 1.6 * 1.6), 1e-9);
  // A cube of 0.027 m3 has edges of 0.3 m and the moment m a^2 / 6.
  EXPECT_NEAR(first_alpha(50, 0.027), 10 / (bare + 50 * 1.6 * 1.6 + 50 * 0.09 / 6), 1e-9);
}

TEST(Actuation, ASoilForceAtTheToolShowsInTheTorque) {
  MachineRun run = LiftArmAt(0);
  run.StepFor(0.2);
  const double before_nm = run.state().effort_nm[0];
  const BodyState& arm = run.state().links[1];
  run.input.soil.link_wrench[1].AddForceAt(Vec3(0, 0, 400), arm.X_WB * Vec3(1.8, 0, 0),
                                           arm.X_WB.translation());
  run.StepFor(0.2);
  EXPECT_NEAR(run.state().effort_nm[0] - before_nm, -400 * 1.8, 1.0);
}

TEST(Actuation, FullLeversGiveTheRatesOfEachDirection) {
  MachineRun run = LiftArmAt(0);
  run.input.levers = {1};
  run.StepFor(1.0);
  EXPECT_NEAR(run.state().qd_radps[0], 30 * kDeg, 1e-6);
  run.input.levers = {-0.5};
  run.StepFor(1.0);
  EXPECT_NEAR(run.state().qd_radps[0], -10 * kDeg, 1e-6);
  run.input.levers = {0};
  run.StepFor(0.5);
  EXPECT_NEAR(run.state().qd_radps[0], 0, 1e-6);
}

TEST(Actuation, LeversBeyondTheirEndsAreClamped) {
  MachineRun run = LiftArmAt(0);
  run.input.levers = {1.7};
  run.StepFor(1.0);
  EXPECT_NEAR(run.state().qd_radps[0], 30 * kDeg, 1e-6);
  EXPECT_EQ(run.state().levers[0], 1.0);
}

TEST(Actuation, TheStepResponseIsThePapersLaw) {
  // Eq. (1) with eta = 20 rad/s, beta = 6 1/s, phi = 0 and a lever of 60 %: values of
  // 1 + sin(20 t) e^(-6 t).
  struct Point {
    double t_s, ratio;
  };
  const Point points[] = {{0.05, 1.6233770377},
                          {0.10, 1.4990330085},
                          {0.20, 0.7720554689},
                          {0.40, 1.0897525552},
                          {1.00, 1.0022629650}};
  const double w_ss = 0.6 * 30 * kDeg;
  MachineModel model =
      WithEffects(MachineFromText(kLiftArm, {"joints.lift.max_effort_nm=100000"}),
                  "lift: {actuator_ring: {eta_radps: 20, beta_1ps: 6, phi_rad: 0}}");
  MachineRun run(model, MakePose(Vec3(1, 2, 0), 0, 0, 1));
  run.input.levers = {0.6};
  int step = 0;
  for (const Point& point : points) {
    for (; step < std::lround(point.t_s / kStep_s); ++step) run.Step();
    EXPECT_NEAR(run.state().qd_radps[0], w_ss * point.ratio, 1e-6 * w_ss) << point.t_s;
  }
}

/// The lift arm at 20 deg, on a pump.
MachinePlacement LoadedArm(const std::string& effects) {
  MachineModel model =
      MachineFromText(kLiftArm, {"joints.lift.displacement_m3prad=1.0e-3",
                                 "pumps.main={max_flow_m3ps: 1.0e-3, feeds: [lift]}"});
  MachinePlacement placement =
      PlaceAtStart(WithEffects(model, effects), MakePose(Vec3(4, -1, 0.3), 0, 0, 2.0));
  placement.q_rad = {20 * kDeg};
  return placement;
}

double LiftWeight_nm(double q_rad) { return 20 * kGravity_mps2 * 0.8 * std::cos(q_rad); }

TEST(Actuation, DroopSettlesOnTheOrificeLawAtItsQuickestToo) {
  for (const char* response_s : {"0", "0.002", "0.01", "0.05"}) {
    MachineRun run(LoadedArm(
        "lift: {pressure_droop: {stall_nm: 200, response_s: " + std::string(response_s) + "}}"));
    run.input.levers = {1};
    run.StepFor(0.5);
    for (int i = 0; i < 250; ++i) {
      const double q_rad = run.state().q_rad[0];
      run.Step();
      const double expected_radps = 30 * kDeg * std::sqrt(1 - LiftWeight_nm(q_rad) / 200);
      EXPECT_NEAR(run.state().qd_radps[0], expected_radps, 0.02 * expected_radps) << response_s;
    }
  }
}

TEST(Actuation, APumpsPowerSettlesOnItsLimitAtItsQuickestToo) {
  for (const char* regulator_s : {"0", "0.002", "0.01", "0.05"}) {
    MachineRun run(LoadedArm(
        "main: {power_limit: {power_w: 40, regulator_s: " + std::string(regulator_s) + "}}"));
    run.input.levers = {1};
    run.StepFor(0.5);
    for (int i = 0; i < 250; ++i) {
      const double q_rad = run.state().q_rad[0];
      run.Step();
      EXPECT_NEAR(run.state().qd_radps[0] * LiftWeight_nm(q_rad), 40, 0.5) << regulator_s;
    }
  }
}

/// The mechanism with every parameter at its lower or at its upper bound.
std::string AtBound(const Mechanism& mechanism, bool upper) {
  std::string text = std::string(mechanism.id) + ": {";
  for (const EffectParameter& parameter : mechanism.parameters) {
    text += fmt::format("{}: {}, ", parameter.name, upper ? parameter.upper : parameter.lower);
  }
  return text + "}";
}

TEST(Actuation, EveryMechanismAtItsBoundsKeepsAJointWithinItsLimits) {
  const MachineModel bare =
      MachineFromText(kCylinderArm, {"pumps.main={max_flow_m3ps: 1.0e-3, feeds: [lift]}"});
  int tried = 0;
  for (const Mechanism& mechanism : ActuationMechanisms()) {
    for (const bool upper : {false, true}) {
      const std::string effect = AtBound(mechanism, upper);
      const bool pump = mechanism.ActsOn(EffectTarget::kPump);
      const MachineModel model = WithEffects(bare, (pump ? "main: {" : "lift: {") + effect + "}");
      if (!FaultsOfJoint(model, 0).empty()) continue;
      ++tried;
      MachineRun run(model, MakePose(Vec3(4, -1, 0.3), 0, 0, 2.0));
      for (int i = 0; i < 1500; ++i) {
        run.input.levers = {std::sin(i * kStep_s * 2) > 0 ? 1.0 : -1.0};
        run.Step();
        const MachineState& state = run.state();
        ASSERT_TRUE(std::isfinite(state.q_rad[0]) && std::isfinite(state.qd_radps[0]) &&
                    std::isfinite(state.effort_nm[0]) && std::isfinite(state.friction_nm[0]))
            << effect;
        // The stop is soft enough to yield 3e-5 rad under a payload of 100 t at 28 m.
        ASSERT_GE(state.q_rad[0], -40 * kDeg - 1e-4) << effect;
        ASSERT_LE(state.q_rad[0], 70 * kDeg + 1e-4) << effect;
        ASSERT_LE(state.friction_nm[0] * state.qd_radps[0], 1e-6) << effect;
      }
    }
  }
  // All but cylinder_lever at its lower bounds, an angle without pins, and dead_band and
  // drive_friction at their upper bounds, at which positive levers, or all levers, have no effect.
  EXPECT_EQ(tried, 2 * static_cast<int>(ActuationMechanisms().size()) - 3);
}

TEST(Actuation, AJointStopsAtItsLimitAndStaysThere) {
  for (const double lever : {1.0, -1.0}) {
    MachineRun run = LiftArmAt(0, {"joints.lift.limits_deg=[-8, 11]"});
    run.input.levers = {lever};
    double lowest = 0, highest = 0;
    for (int i = 0; i < 1000; ++i) {
      run.Step();
      lowest = std::min(lowest, run.state().q_rad[0]);
      highest = std::max(highest, run.state().q_rad[0]);
    }
    EXPECT_GE(lowest, -8 * kDeg - 1e-9);
    EXPECT_LE(highest, 11 * kDeg + 1e-9);
    EXPECT_NEAR(run.state().q_rad[0], (lever > 0 ? 11 : -8) * kDeg, 1e-6);
  }
}

TEST(Actuation, AJointThatLeaksAtMostLiesStillAtItsStops) {
  const Mechanism* sag = nullptr;
  for (const Mechanism& mechanism : ActuationMechanisms()) {
    if (mechanism.id == "sag") sag = &mechanism;
  }
  const std::string most = fmt::format("{{sag: {{drift_radps: {}}}}}", sag->parameters[0].upper);
  const MachineModel bare = ShippedMachine("tb235", {"fixed_base=true"});
  for (const char* name : {"boom", "arm", "bucket"}) {
    const MachineModel model = WithEffects(bare, std::string(name) + ": " + most);
    const int joint = model.JointIndex(name), lever = model.LeverIndex(name);
    for (const double toward : {-1.0, 1.0}) {
      MachineRun run(model, MakePose(Vec3(4, -1, 0.3), 0, 0, 2.0));
      double jump_nm = 0;
      for (int i = 0; i < 5000; ++i) {
        run.input.levers[lever] = i < 4000 ? toward : 0;
        const double before_nm = run.state().effort_nm[joint];
        run.Step();
        if (i < 3000 || (i >= 4000 && i < 4250)) continue;  // on its way
        jump_nm = std::max(jump_nm, std::abs(run.state().effort_nm[joint] - before_nm));
      }
      EXPECT_LT(jump_nm, 0.01 * model.joints[joint].max_effort_nm) << name << " " << toward;
    }
  }
}

TEST(Actuation, AStopHoldsWhatTheMotorCannot) {
  // 20 kg at 0.8 m need 157 N m; the motor has 20.
  MachineRun run =
      LiftArmAt(0, {"joints.lift.limits_deg=[-30, 40]", "joints.lift.max_effort_nm=20"});
  run.StepFor(3.0);
  EXPECT_NEAR(run.state().q_rad[0], -30 * kDeg, 1e-6);
  EXPECT_NEAR(run.state().effort_nm[0], 20 * kGravity_mps2 * 0.8 * std::cos(30 * kDeg), 0.5);
}

TEST(Actuation, AnOverloadedMotorStalls) {
  MachineRun run = LiftArmAt(0, {"joints.lift.max_effort_nm=400"});
  run.input.levers = {1};
  run.input.soil.shovel_load = {{.mass_kg = 60, .com_B_m = Vec3(1.6, 0, 0), .volume_m3 = 0.03}};
  run.StepFor(0.3);
  EXPECT_LT(run.state().qd_radps[0], 0);  // sinks: 157 + 942 N m against 400
  EXPECT_NEAR(run.state().effort_nm[0], 400, 1e-6);
}

TEST(Actuation, AGearReachesItsSpeedAndYieldsToTraction) {
  const MachineModel model = ShippedMachine("tb235");
  MachineRun run(model, Pose::Identity(), 0.0);
  run.input.levers[0] = 0.5;
  run.input.soil.gear_traction_n = {4000, 0};
  run.StepFor(2.0);
  EXPECT_NEAR(run.state().gear_rate_radps[0], 0.5 * 1.25 / 0.25, 1e-4);
  EXPECT_NEAR(run.state().gear_torque_nm[0], 4000 * 0.25, 0.1);
  EXPECT_NEAR(run.state().gear_rate_radps[1], 0, 1e-12);
  const double angle = run.state().gear_angle_rad[0];
  run.StepFor(1.0);
  EXPECT_NEAR(run.state().gear_angle_rad[0] - angle, 2.5, 1e-3);
  // 30 kN at 0.25 m are more than the motor's 6 kN m: (6000 - 7500) / 25 rad/s2 for 20 ms.
  run.input.soil.gear_traction_n = {30000, 0};
  run.StepFor(0.02);
  EXPECT_NEAR(run.state().gear_torque_nm[0], 6000, 1e-9);
  EXPECT_NEAR(run.state().gear_rate_radps[0], 2.5 - 1500.0 / 25 * 0.02, 1e-3);
}

}  // namespace
}  // namespace tera
