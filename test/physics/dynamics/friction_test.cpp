#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "physics/machine_fixture.h"

// Friction, leaks and payloads in the multibody.

namespace tera {
namespace {

/// The pendulum let go at `angle_rad`, its bearing with `effects`.
MachineRun Pendulum(double angle_rad, const std::string& effects) {
  const MachineModel model = WithEffects(MachineFromText(kPendulum), "pin: {" + effects + "}");
  MachinePlacement placement = PlaceAtStart(model, MakePose(Vec3(1, 2, 3), 0, 0, 0.8));
  placement.q_rad = {angle_rad};
  return MachineRun(placement);
}

constexpr double kPendulumGravity_nm = 4 * kGravity_mps2 * 0.6;
constexpr double kPendulumInertia_kgm2 = 0.48 + 4 * 0.6 * 0.6;

/// Largest angle of each positive swing, starting with the initial one.
std::vector<double> Peaks(MachineRun run, int count) {
  std::vector<double> peaks = {run.state().q_rad[0]};
  double highest = 0;
  while (static_cast<int>(peaks.size()) <= count) {
    const double before = run.state().q_rad[0];
    run.Step();
    const double q = run.state().q_rad[0];
    highest = std::max(highest, q);
    if (before > 0 && q <= 0) {
      if (highest < peaks.back() * 0.9999) peaks.push_back(highest);
      highest = 0;
    }
  }
  return peaks;
}

TEST(Friction, APassiveArmNeverGainsEnergy) {
  MachineModel model = ShippedMachine("fixed_arm");
  for (Joint& joint : model.joints) {
    joint.type = JointType::kContinuous;
    joint.max_effort_nm = 0;
  }
  std::string effects;
  for (const Joint& joint : model.joints) {
    effects += joint.name +
               ": {coulomb_friction: {effort_nm: 20}, viscous_friction: {coefficient_nmsprad: 15}, "
               "stribeck_friction: {excess_nm: 30, rate_radps: 0.1}, asymmetric_friction: "
               "{positive_nm: 10}}\n";
  }
  model = WithEffects(model, effects);
  MachinePlacement placement = PlaceAtStart(model, MakePose(Vec3(2, 1, 0.5), 0, 0, 0.6));
  placement.q_rad = {-40 * kDeg, 20 * kDeg, -30 * kDeg};
  MachineRun run(placement);
  placement.q_rad = {-90 * kDeg, 0, 0};
  const MachineRun hanging(placement);
  const double start_j = Energy_j(model, run.state(), run.state());
  const double swing_j = start_j - Energy_j(model, hanging.state(), hanging.state());
  double lowest_j = start_j;
  for (int i = 0; i < 15000; ++i) {
    const MachineState before = run.state();
    run.Step();
    const double energy_j = Energy_j(model, before, run.state());
    EXPECT_LT(energy_j, lowest_j + 2e-4 * swing_j);
    lowest_j = std::min(lowest_j, energy_j);
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_LE(run.state().friction_nm[j] * run.state().qd_radps[j], 1e-9);
    }
  }
  EXPECT_LT(lowest_j, start_j - 0.9 * swing_j);
  for (const double rate : run.state().qd_radps) EXPECT_NEAR(rate, 0, 1e-6);
}

TEST(Friction, CoulombFrictionTakesTheSameFromEverySwing) {
  // Harmonic motion loses 4 F / (m g d) of amplitude per period. At 0.25 rad the pendulum's
  // restoring torque is weaker than harmonic by about a^2 / 6.
  const std::vector<double> peaks = Peaks(Pendulum(0.25, "coulomb_friction: {effort_nm: 0.2}"), 5);
  for (std::size_t k = 1; k < peaks.size(); ++k) {
    EXPECT_NEAR(peaks[k - 1] - peaks[k], 4 * 0.2 / kPendulumGravity_nm, 0.015 * 0.034);
  }
}

TEST(Friction, ViscousFrictionTakesTheSameShareOfEverySwing) {
  // Logarithmic decrement c T / (2 I), T the damped period.
  const double c = 0.4, w0 = std::sqrt(kPendulumGravity_nm / kPendulumInertia_kgm2);
  const double decay = c / (2 * kPendulumInertia_kgm2);
  const double decrement = decay * 2 * kPi / std::sqrt(w0 * w0 - decay * decay);
  const std::vector<double> peaks =
      Peaks(Pendulum(0.1, "viscous_friction: {coefficient_nmsprad: 0.4}"), 4);
  for (std::size_t k = 1; k < peaks.size(); ++k) {
    EXPECT_NEAR(std::log(peaks[k - 1] / peaks[k]), decrement, 0.01 * decrement);
  }
}

/// The lift arm without a motor, held up by its bearing alone: 157 N m of weight.
MachineRun UnpoweredArm(double coulomb_nm) {
  MachineModel model = MachineFromText(kLiftArm, {"joints.lift.max_effort_nm=0"});
  model = WithEffects(model,
                      "lift: {coulomb_friction: {effort_nm: " + std::to_string(coulomb_nm) + "}}");
  return MachineRun(model, MakePose(Vec3(1, 2, 0), 0, 0, 1));
}

TEST(Friction, AJointThatCoulombFrictionHoldsStays) {
  MachineRun run = UnpoweredArm(160);
  run.StepFor(10);
  EXPECT_NEAR(run.state().q_rad[0], 0, 1e-7);
  EXPECT_NEAR(run.state().friction_nm[0], 20 * kGravity_mps2 * 0.8, 1e-3);
  EXPECT_EQ(run.state().effort_nm[0], 0);
}

TEST(Friction, AJointThatCoulombFrictionCannotHoldFallsWithTheRest) {
  MachineRun run = UnpoweredArm(100);
  run.StepFor(0.02);
  const double alpha = (20 * kGravity_mps2 * 0.8 - 100) / (3.0 + 20 * 0.64);
  EXPECT_NEAR(run.state().qd_radps[0], -alpha * 0.02, 1e-3 * alpha);
}

/// The lift arm without weight.
MachineRun WeightlessArm(const std::string& effects, double max_effort_nm = 2000) {
  MachineModel model =
      MachineFromText(kLiftArm, {"joints.lift.max_effort_nm=" + std::to_string(max_effort_nm)});
  return MachineRun(WithEffects(model, "lift: {" + effects + "}"), Pose::Identity(), 0.0);
}

TEST(Friction, TheMotorBearsTheFrictionOfASteadyMotion) {
  MachineRun run = WeightlessArm(
      "coulomb_friction: {effort_nm: 150}, viscous_friction: {coefficient_nmsprad: 100}, "
      "asymmetric_friction: {negative_nm: 40}");
  run.input.levers = {1};
  run.StepFor(0.5);
  const double up = 150 + 100 * 30 * kDeg;
  EXPECT_NEAR(run.state().effort_nm[0], up, 1e-3);
  EXPECT_NEAR(run.state().friction_nm[0], -up, 1e-3);
  EXPECT_NEAR(run.state().qd_radps[0], 30 * kDeg, 1e-9);
  run.input.levers = {-1};
  run.StepFor(0.5);
  EXPECT_NEAR(run.state().effort_nm[0], -(190 + 100 * 20 * kDeg), 1e-3);
  run.input.levers = {0};
  run.StepFor(0.5);
  EXPECT_NEAR(run.state().effort_nm[0], 0, 1e-3);
}

TEST(Friction, TheMotorMakesUpForAnOffsetBothWays) {
  MachineRun run = WeightlessArm("effort_offset: {effort_nm: -70}");
  for (const double lever : {1.0, -1.0, 0.0}) {
    run.input.levers = {lever};
    run.StepFor(0.5);
    EXPECT_NEAR(run.state().effort_nm[0], -70, 1e-3) << lever;
  }
}

/// Inertia of the lift arm about its pin.
constexpr double kLiftInertia_kgm2 = 3.0 + 20 * 0.64;

/// Rates of the weightless, unpowered lift arm with a viscous bearing, while `torque_nm` acts for
/// `push_s`, and then until `end_s`.
std::vector<double> PushedRates_radps(double viscous_nmsprad, double torque_nm, double push_s,
                                      double end_s) {
  MachineRun run = WeightlessArm(
      "viscous_friction: {coefficient_nmsprad: " + std::to_string(viscous_nmsprad) + "}", 0);
  std::vector<double> rates_radps;
  for (int i = 0; i * kStep_s < end_s; ++i) {
    // Positive angles turn about -y.
    run.input.soil.link_wrench[1].torque_W_nm = Vec3(0, i * kStep_s < push_s ? -torque_nm : 0, 0);
    run.Step();
    rates_radps.push_back(run.state().qd_radps[0]);
    EXPECT_NEAR(run.state().friction_nm[0], -viscous_nmsprad * rates_radps.back(),
                1e-6 * torque_nm);
  }
  return rates_radps;
}

TEST(Friction, AStiffDamperLetsALoadCreepAtItsSteadyRate) {
  // Ten times the stable limit of an explicit scheme: c dt / I = 20.
  const double c = 20 * kLiftInertia_kgm2 / kStep_s;
  const std::vector<double> rates = PushedRates_radps(c, 300, 0.1, 0.2);
  double last = 0;
  for (int i = 0; i < 50; ++i) {
    EXPECT_GE(rates[i], last);
    EXPECT_LE(rates[i], 300 / c * (1 + 1e-6));
    last = rates[i];
  }
  EXPECT_NEAR(last, 300 / c, 1e-6 * 300 / c);
  for (std::size_t i = 50; i < rates.size(); ++i) {
    EXPECT_LE(rates[i], last);
    EXPECT_GE(rates[i], 0);
    last = rates[i];
  }
  EXPECT_NEAR(last, 0, 1e-12);
}

TEST(Friction, ADamperSlowsAFreeJointExponentially) {
  const double c = 2 * kLiftInertia_kgm2;  // a time constant of 0.5 s
  const std::vector<double> rates = PushedRates_radps(c, 500, 0.02, 1.02);
  for (std::size_t i = 10; i < rates.size(); ++i) {
    const double t_s = (static_cast<double>(i) - 9) * kStep_s;
    EXPECT_NEAR(rates[i], rates[9] * std::exp(-2 * t_s), 0.005 * rates[i]);
  }
}

TEST(Friction, StiffDampersOfAChainOfLinksTakeEnergyAndLetItSinkSteadily) {
  MachineModel model = ShippedMachine("fixed_arm");
  std::string effects;
  for (Joint& joint : model.joints) {
    joint.type = JointType::kContinuous;
    joint.max_effort_nm = 0;
    effects += joint.name + ": {viscous_friction: {coefficient_nmsprad: 1.0e+6}}\n";
  }
  model = WithEffects(model, effects);
  MachinePlacement placement = PlaceAtStart(model, MakePose(Vec3(2, 1, 0.5), 0, 0, 0.6));
  placement.q_rad = {-40 * kDeg, 20 * kDeg, -30 * kDeg};
  MachineRun run(placement);
  run.Step(50);
  const MachineState begin = run.state();
  double dissipated_j = 0;
  for (int i = 0; i < 500; ++i) {
    const MachineState before = run.state();
    run.Step();
    for (std::size_t j = 0; j < 3; ++j) {
      const double rate = run.state().qd_radps[j], last = before.qd_radps[j];
      EXPECT_NEAR(rate, last, 0.01 * std::abs(last));
      dissipated_j -= run.state().friction_nm[j] * rate * kStep_s;
    }
  }
  // So slow that all lost height becomes heat.
  const double lost_j = Energy_j(model, begin, begin) - Energy_j(model, run.state(), run.state());
  EXPECT_GT(lost_j, 0);
  EXPECT_NEAR(dissipated_j, lost_j, 1e-3 * lost_j);
}

TEST(Friction, AMotorWeakerThanItsFrictionDoesNotMoveTheJoint) {
  MachineRun run = WeightlessArm("coulomb_friction: {effort_nm: 150}", 140);
  run.input.levers = {1};
  run.StepFor(1);
  EXPECT_NEAR(run.state().q_rad[0], 0, 1e-7);
  EXPECT_NEAR(run.state().effort_nm[0], 140, 1e-3);
}

TEST(Friction, AHeldJointSagsAtTheRateOfItsLoad) {
  // 20 kg at 0.8 m on a drive of 2000 N m that drifts 0.05 rad/s at full effort.
  MachineModel model = WithEffects(MachineFromText(kLiftArm), "lift: {sag: {drift_radps: 0.05}}");
  MachineRun run(model, MakePose(Vec3(1, 2, 0), 0, 0, 1));
  run.StepFor(10);
  const double rate = 0.05 * 20 * kGravity_mps2 * 0.8 / 2000;
  EXPECT_NEAR(run.state().q_rad[0], -10 * rate, 0.01 * 10 * rate);
}

TEST(Friction, AFlexibleJointAtRestIsBentByItsLoadAlready) {
  // 157 N m on a spring of 1000 N m/rad, whose stated angle is that under load.
  MachineModel model = WithEffects(
      MachineFromText(kLiftArm),
      "lift: {structural_flex: {natural_radps: 8, damping: 0.1, compliance_radpnm: 0.001}}");
  MachineRun run(model, MakePose(Vec3(1, 2, 0), 0, 0, 1));
  run.StepFor(2);
  EXPECT_NEAR(run.state().q_rad[0], 0, 1e-4);
}

TEST(Friction, AJointThatFrictionHoldsDoesNotSag) {
  MachineModel model =
      WithEffects(MachineFromText(kLiftArm),
                  "lift: {sag: {drift_radps: 0.05}, coulomb_friction: {effort_nm: 200}}");
  MachineRun run(model, MakePose(Vec3(1, 2, 0), 0, 0, 1));
  run.StepFor(10);
  EXPECT_NEAR(run.state().q_rad[0], 0, 1e-6);
}

TEST(Friction, ABucketsTorqueGrowsWithItsPayload) {
  // Boom 45, arm -120, bucket 30: the bucket's x axis points down (45 - 120 + 30 - 45 deg) and its
  // z axis ahead, with the payload 0.45 m ahead of the pin. The relief pressure holds this much
  // here, but not with a stretched arm.
  const auto torque_nm = [](double mass_kg) {
    MachineModel model = ShippedMachine("tb235", {"fixed_base=true"});
    model = WithEffects(model, "bucket: {payload: {x_m: 0.15, z_m: 0.45, mass_kg: " +
                                   std::to_string(mass_kg) + "}}");
    MachinePlacement placement = PlaceAtStart(model, MakePose(Vec3(3, 1, 0), 0, 0, 0.7));
    placement.q_rad[model.JointIndex("boom")] = 45 * kDeg;
    placement.q_rad[model.JointIndex("arm")] = -120 * kDeg;
    placement.q_rad[model.JointIndex("bucket")] = 30 * kDeg;
    MachineRun run(placement);
    run.StepFor(0.5);
    return run.state().effort_nm[model.JointIndex("bucket")];
  };
  const double empty_nm = torque_nm(0);
  for (double mass_kg = 100; mass_kg <= 500; mass_kg += 100) {
    const double expected_nm = mass_kg * kGravity_mps2 * 0.45;
    EXPECT_NEAR(torque_nm(mass_kg) - empty_nm, expected_nm, 0.01 * expected_nm) << mass_kg;
  }
}

TEST(Friction, APayloadHasItsInertia) {
  // Weightless and with a saturated motor: alpha = torque / inertia.
  MachineRun run = WeightlessArm("payload: {mass_kg: 50, x_m: 1.6, y_m: 0.3}", 10);
  run.input.levers = {1};
  run.Step();
  EXPECT_NEAR(run.state().qd_radps[0] / kStep_s, 10 / (3.0 + 20 * 0.64 + 50 * 2.56), 1e-9);
}

TEST(Friction, OfAGearTakesItsMotorsTorque) {
  const MachineModel model = WithEffects(ShippedMachine("tb235"),
                                         "left_track: {coulomb_friction: {effort_nm: 400}, "
                                         "viscous_friction: {coefficient_nmsprad: 100}}");
  MachineRun run(model, Pose::Identity(), 0.0);
  run.input.levers[0] = 0.5;
  run.input.soil.gear_traction_n = {4000, 0};
  run.StepFor(2.0);
  EXPECT_NEAR(run.state().gear_rate_radps[0], 2.5, 1e-9);
  EXPECT_NEAR(run.state().gear_torque_nm[0], 4000 * 0.25 + 400 + 100 * 2.5, 0.1);
  EXPECT_NEAR(run.state().gear_friction_nm[0], -650, 1e-6);
}

TEST(Friction, AStiffDamperOfAGearLetsTractionCreepIt) {
  // 25 kg m2 at 500 Hz: an explicit scheme bears 25000 N m s/rad.
  MachineModel model = WithEffects(ShippedMachine("tb235"),
                                   "left_track: {viscous_friction: {coefficient_nmsprad: 250000}}");
  for (GearDrive& drive : model.gear_drives) drive.max_torque_nm = 0;
  MachineRun run(model, Pose::Identity(), 0.0);
  run.input.soil.gear_traction_n = {4000, 0};  // 1000 N m
  double last = 0;
  for (int i = 0; i < 50; ++i) {
    run.Step();
    const double rate = run.state().gear_rate_radps[0];
    EXPECT_LE(rate, last);
    EXPECT_GE(rate, -1000.0 / 250000 * (1 + 1e-9));
    EXPECT_NEAR(run.state().gear_friction_nm[0], -250000 * rate, 1e-6);
    last = rate;
  }
  EXPECT_NEAR(last, -1000.0 / 250000, 1e-9);
}

TEST(Friction, OfAGearHoldsItAgainstLessTractionThanItself) {
  MachineModel model =
      WithEffects(ShippedMachine("tb235"), "left_track: {coulomb_friction: {effort_nm: 400}}");
  for (GearDrive& drive : model.gear_drives) drive.max_torque_nm = 0;
  MachineRun run(model, Pose::Identity(), 0.0);
  run.input.soil.gear_traction_n = {1500, 1500};  // 375 N m
  run.StepFor(1.0);
  EXPECT_EQ(run.state().gear_rate_radps[0], 0);
  EXPECT_NEAR(run.state().gear_friction_nm[0], 375, 1e-9);
  EXPECT_NEAR(run.state().gear_rate_radps[1], -375.0 / 25, 1e-9);
  run.input.soil.gear_traction_n = {2000, 0};  // 500 N m: 100 of them turn 25 kg m2
  run.StepFor(1.0);
  EXPECT_NEAR(run.state().gear_rate_radps[0], -100.0 / 25, 1e-9);
  run.input.soil.gear_traction_n = {0, 0};
  run.StepFor(1.0);
  EXPECT_EQ(run.state().gear_rate_radps[0], 0);
}

}  // namespace
}  // namespace tera
