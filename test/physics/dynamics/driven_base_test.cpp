#include <gtest/gtest.h>

#include <cmath>

#include "physics/machine_fixture.h"
#include "physics/traction/ground_mechanisms.h"

/// A weightless machine whose base is driven over the ground (`ground: ideal` and `kinematic`),
/// under given forces.

namespace tera {
namespace {

/// 1000 kg on two tracks of 2 m; `blade` is the blade's support.
std::string Pusher(const std::string& blade) {
  return R"(
kind: pusher
links:
  chassis: {mass_kg: 900, com_m: [0.2, 0, 0.5], inertia_kgm2: [300, 500, 600]}
  mount: {mass_kg: 50, inertia_kgm2: [5, 5, 5]}
  arm: {mass_kg: 50, inertia_kgm2: [5, 5, 5]}
joints:
  weld: {type: fixed, parent: chassis, child: mount, xyz_m: [1.2, 0.1, 0.4], rpy_deg: [0, 10, 20]}
  hinge:
    type: revolute
    parent: chassis
    child: arm
    xyz_m: [1.0, 0, 0.4]
    axis: [0, -1, 0]
    limits_deg: [-20, 20]
    max_rate_degps: 20
    max_effort_nm: 1.0e6
gauge_m: 1.2
tracks:
  left: {link: chassis, center_m: [0, 0.6, 0.3], wheelbase_m: 2, radius_m: 0.3, width_m: 0.3, max_speed_mps: 1, max_torque_nm: 1.0e5, inertia_kgm2: 10}
  right: {link: chassis, center_m: [0, -0.6, 0.3], wheelbase_m: 2, radius_m: 0.3, width_m: 0.3, max_speed_mps: 1, max_torque_nm: 1.0e5, inertia_kgm2: 10}
levers: [left, right]
shovels:
  blade: {link: )" +
         blade +
         R"(, profile_m: [[0.5, -0.3], [0.4, 0], [0.5, 0.3]], width_m: 2}
)";
}

constexpr double kMass_kg = 1000;
const Pose kAt = MakePose(Vec3(3, -2, 0), 0, 0, 40 * kDeg);

Vec3 VelocityInRoot(const MachineRun& run) {
  const BodyState& base = run.state().links[0];
  return base.X_WB.linear().transpose() * base.v_WB_mps;
}

Effects BaseEffects(const std::string& yaml) {
  const Config config = Config::FromText(yaml, "base.yaml");
  Effects effects = ReadEffects(config.root(), EffectTarget::kBase, GroundMechanisms());
  config.Finish();
  return effects;
}

/// Speed at which a force on the blade drags the machine forward.
double Dragged_mps(const std::string& blade, double force_n) {
  MachineModel model = MachineFromText(Pusher(blade));
  model.ground = GroundModel::kKinematic;
  model.effects.base = BaseEffects("digging_force: {yield_mps: 0.5, holding: 0.3}");
  MachineRun run(model, kAt, 0.0);
  run.input.soil.gear_grip_n = {1e6, 1e6};
  for (int step = 0; step < 500; ++step) {
    const int link = model.ground_tools.shovels[0].link;
    const BodyState& base = run.state().links[0];
    // Ahead of the middle of the contact, where it does not turn the machine.
    run.input.soil.link_wrench[link] = Wrench();
    run.input.soil.link_wrench[link].AddForceAt(base.X_WB.linear() * Vec3(force_n, 0, 0),
                                                base.X_WB * Vec3(1.5, 0, 0),
                                                run.state().links[link].X_WB.translation());
    // A force that supports the root is no tool force.
    run.input.soil.link_wrench[0].force_W_n = base.X_WB.linear() * Vec3(0, 4000, 0);
    run.Step();
  }
  return VelocityInRoot(run).x();
}

TEST(DrivenBase, ABladeDragsTheMachineOnAHingeOrWelded) {
  // Half the weight: 0.2 of it beyond the holding force, at 0.5 m/s per weight.
  const double weight_n = kMass_kg * kStandardGravity_mps2;
  for (const char* blade : {"arm", "mount"}) {
    EXPECT_NEAR(Dragged_mps(blade, 0.5 * weight_n), 0.1, 1e-3) << blade;
    EXPECT_NEAR(Dragged_mps(blade, 0.2 * weight_n), 0, 1e-3) << blade;
  }
}

TEST(DrivenBase, AForceOnALinkFixedToTheRootActsOnTheWholeMachine) {
  // Without grip it is free: 1000 kg, pushed at the height of its centre of mass.
  const MachineModel model = MachineFromText(Pusher("mount"));
  MachineRun run(model, kAt, 0.0);
  const Mat3 R_WB = run.state().links[0].X_WB.linear();
  run.input.soil.link_wrench[1].force_W_n = R_WB * Vec3(500, 0, 0);
  run.Step();
  Vec3 momentum = Vec3::Zero();
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    momentum +=
        model.links[i].mass_kg * PointVelocity(run.state().links[i], model.links[i].com_B_m);
  }
  EXPECT_LT((R_WB.transpose() * momentum - Vec3(500 * kStep_s, 0, 0)).norm(), 1e-6);
}

/// The largest force along that direction of B which a base with 2 kN of grip holds, in newtons.
double Held_n(double direction_rad) {
  MachineModel model = MachineFromText(Pusher("arm"));
  model.ground = GroundModel::kIdeal;
  double low_n = 0, high_n = 10e3;
  while (high_n - low_n > 1) {
    const double force_n = 0.5 * (low_n + high_n);
    MachineRun run(model, kAt, 0.0);
    run.input.soil.gear_grip_n = {1000, 1000};
    // At the middle of the contact, the origin of the root.
    run.input.soil.link_wrench[0].force_W_n =
        run.state().links[0].X_WB.linear() *
        (force_n * Vec3(std::cos(direction_rad), std::sin(direction_rad), 0));
    run.StepFor(0.2);
    (VelocityInRoot(run).norm() < 1e-3 ? low_n : high_n) = force_n;
  }
  return low_n;
}

TEST(DrivenBase, HoldsItsGripAlongEachAxisForItself) {
  EXPECT_NEAR(Held_n(0), 2000, 10);
  EXPECT_NEAR(Held_n(90 * kDeg), 2000, 10);
  EXPECT_NEAR(Held_n(180 * kDeg), 2000, 10);
  // Across the corner of the box instead of a circle of friction: sqrt(2) of it.
  EXPECT_NEAR(Held_n(45 * kDeg), 2000 * std::sqrt(2), 15);
}

}  // namespace
}  // namespace tera
