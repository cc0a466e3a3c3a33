#include "physics/dynamics/physics_world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/machine_fixture.h"

namespace tera {
namespace {

TEST(PhysicsWorld, AMachineFallsFreely) {
  const MachineModel model = ShippedMachine("tb235");
  const Pose X_WB = MakePose(Vec3(3, -4, 50), 0.2, -0.1, 1.0);
  MachineRun run(model, X_WB);
  run.StepFor(2.0);
  const BodyState& base = run.state().links[0];
  // v = g t; the position of the semi-implicit scheme is late by v dt / 2.
  EXPECT_NEAR(base.v_WB_mps.z(), -kGravity_mps2 * 2.0, 1e-6);
  EXPECT_NEAR(base.X_WB.translation().z(), 50 - kGravity_mps2 * 2.0 * 2.0 / 2,
              kGravity_mps2 * 2.0 * kStep_s / 2 + 1e-6);
  EXPECT_TRUE(base.X_WB.linear().isApprox(X_WB.linear(), 1e-9));
  for (const BodyState& link : run.state().links) {
    EXPECT_TRUE(link.a_WB_mps2.isApprox(Vec3(0, 0, -kGravity_mps2), 1e-6));
    EXPECT_LT(link.alpha_WB_radps2.norm(), 1e-6);
  }
}

TEST(PhysicsWorld, PendulumSwingsWithItsLiteraturePeriod) {
  const MachineModel model = MachineFromText(kPendulum);
  const double amplitude_rad = 0.3;
  MachinePlacement placement = PlaceAtStart(model, MakePose(Vec3(1, 2, 3), 0, 0, 0.8));
  placement.q_rad = {amplitude_rad};
  MachineRun run(placement);
  // T = 2 pi sqrt(I / (m g d)) (1 + a^2/16 + 11 a^4/3072), I about the pin.
  const double inertia = 0.48 + 4 * 0.6 * 0.6;
  const double a2 = amplitude_rad * amplitude_rad;
  const double period_s = 2 * kPi * std::sqrt(inertia / (4 * kGravity_mps2 * 0.6)) *
                          (1 + a2 / 16 + 11 * a2 * a2 / 3072);
  const int swings = 5;
  int downward = 0;
  double crossing_s = 0, first_s = 0;
  for (int i = 1; downward <= swings; ++i) {
    ASSERT_LT(i, 20000);
    const double before = run.state().q_rad[0];
    run.Step();
    const double after = run.state().q_rad[0];
    if (before <= 0 || after > 0) continue;
    crossing_s = (i - after / (after - before)) * kStep_s;
    if (downward++ == 0) first_s = crossing_s;
  }
  EXPECT_NEAR((crossing_s - first_s) / swings, period_s, 1e-4 * period_s);
}

TEST(PhysicsWorld, APassiveArmKeepsItsEnergy) {
  MachineModel model = ShippedMachine("fixed_arm");
  for (Joint& joint : model.joints) {
    joint.type = JointType::kContinuous;
    joint.max_effort_nm = 0;
  }
  const auto start_at = [&](const std::vector<double>& q_rad) {
    MachinePlacement placement = PlaceAtStart(model, MakePose(Vec3(2, 1, 0.5), 0, 0, 0.6));
    placement.q_rad = q_rad;
    return MachineRun(placement);
  };
  const MachineRun hanging = start_at({-90 * kDeg, 0, 0});
  MachineRun run = start_at({-40 * kDeg, 20 * kDeg, -30 * kDeg});
  const double start_j = Energy_j(model, run.state(), run.state());
  const double swing_j = start_j - Energy_j(model, hanging.state(), hanging.state());
  double largest_error_j = 0, fastest_radps = 0;
  for (int i = 0; i < 5000; ++i) {
    const MachineState before = run.state();
    run.Step();
    const double error_j = std::abs(Energy_j(model, before, run.state()) - start_j);
    largest_error_j = std::max(largest_error_j, error_j);
    fastest_radps = std::max(fastest_radps, std::abs(run.state().qd_radps[2]));
  }
  EXPECT_GT(fastest_radps, 3.0);
  EXPECT_LT(largest_error_j, 1e-3 * swing_j);
}

TEST(PhysicsWorld, AFloatingMachineKeepsItsMomentumWhileItsArmMoves) {
  const MachineModel model = ShippedMachine("tb235");
  MachineRun run(model, MakePose(Vec3(1, 2, 3), 0.1, 0.2, 0.3), 0.0);
  run.input.levers = {0, 0, 0.7, -0.3, -0.5, 0.8, 0.6, 0.4};
  run.StepFor(1.5);
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
  Vec3 com_W = Vec3::Zero();
  double largest = 0;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    const BodyState& body = run.state().links[i];
    const Vec3 p = link.mass_kg * PointVelocity(body, link.com_B_m);
    const Mat3 R = body.X_WB.linear();
    const Vec3 spin = R * link.inertia_B_kgm2 * R.transpose() * body.w_WB_radps;
    momentum += p;
    com_W += link.mass_kg / model.TotalMass_kg() * (body.X_WB * link.com_B_m);
    angular += (body.X_WB * link.com_B_m).cross(p) + spin;
    largest = std::max(largest, p.norm());
  }
  ASSERT_GT(largest, 50);
  // Rates are conserved, not momenta, while the pose advances within a step. The error is of first
  // order, here less than a millimetre per second for the whole machine.
  EXPECT_LT(momentum.norm(), 3500 * 1e-3);
  EXPECT_LT((angular - com_W.cross(momentum)).norm(), 2e-2 * largest);
}

TEST(PhysicsWorld, AccelerationsIntegrateToTheVelocities) {
  const MachineModel model = ShippedMachine("tb235");
  MachineRun run(model, MakePose(Vec3(1, 2, 3), 0.1, 0.2, 0.3));
  run.input.levers = {0, 0, 1, 0, -0.5, 0.8, 0.6, 0};
  const int bucket = model.LinkIndex("bucket");
  Vec3 v = run.state().links[bucket].v_WB_mps, w = run.state().links[bucket].w_WB_radps;
  Vec3 p = run.state().links[bucket].X_WB.translation();
  for (int i = 0; i < 500; ++i) {
    run.Step();
    const BodyState& link = run.state().links[bucket];
    v += link.a_WB_mps2 * kStep_s;
    w += link.alpha_WB_radps2 * kStep_s;
    p += v * kStep_s;
  }
  const BodyState& link = run.state().links[bucket];
  EXPECT_TRUE(v.isApprox(link.v_WB_mps, 1e-9));
  EXPECT_TRUE(w.isApprox(link.w_WB_radps, 1e-9));
  // 10 m in a second of turning: the pose must follow the velocity to a few millimetres.
  EXPECT_LT((p - link.X_WB.translation()).norm(), 5e-3);
}

TEST(PhysicsWorld, AFixedBaseStaysWhateverPulls) {
  const MachineModel model = ShippedMachine("fixed_arm");
  const Pose X_WB = MakePose(Vec3(2, 1, 0.5), 0.1, 0, 0.6);
  MachineRun run(model, X_WB);
  run.input.levers = {1, -1, 0.5};
  run.input.soil.link_wrench[3].force_W_n = Vec3(300, 200, -100);
  run.StepFor(1.0);
  EXPECT_TRUE(run.state().links[0].X_WB.isApprox(X_WB, 1e-12));
  EXPECT_EQ(run.state().links[0].v_WB_mps.norm(), 0);
}

TEST(PhysicsWorld, AWrenchActsAboutTheLinkFrame) {
  // A lone body of 10 kg, its centre of mass 0.5 m ahead of its frame, turned to the left.
  const MachineModel model = MachineFromText(R"(
kind: body
links:
  body: {mass_kg: 10, com_m: [0.5, 0, 0], inertia_kgm2: [1, 2, 2.5, 0.2, 0, 0.1]}
)");
  const Pose X_WB = MakePose(Vec3(1, 2, 3), 0, 0, 90 * kDeg);
  MachineRun run(model, X_WB, 0.0);
  // A force at the centre of mass, given about B's origin: no rotation.
  const Vec3 com_W = X_WB * Vec3(0.5, 0, 0);
  run.input.soil.link_wrench[0].AddForceAt(Vec3(7, -3, 20), com_W, X_WB.translation());
  run.Step();
  const BodyState& body = run.state().links[0];
  EXPECT_TRUE(body.a_WB_mps2.isApprox(Vec3(0.7, -0.3, 2.0), 1e-9));
  EXPECT_LT(body.alpha_WB_radps2.norm(), 1e-9);
  // A pure torque turns it by the inverse of its inertia, about the centre of mass.
  MachineRun turn(model, X_WB, 0.0);
  turn.input.soil.link_wrench[0].torque_W_nm = Vec3(0, 0, 5);
  turn.Step();
  const Mat3 R = X_WB.linear();
  const Vec3 alpha = R * model.links[0].inertia_B_kgm2.inverse() * R.transpose() * Vec3(0, 0, 5);
  EXPECT_TRUE(turn.state().links[0].alpha_WB_radps2.isApprox(alpha, 1e-5));
  const Vec3 a_com = turn.state().links[0].a_WB_mps2 + alpha.cross(R * Vec3(0.5, 0, 0));
  EXPECT_LT(a_com.norm(), 1e-4);
}

TEST(PhysicsWorld, AnExcavatorOnSpringsSettlesUnderItsWeight) {
  const MachineModel model = ShippedMachine("tb235");
  // Explicit springs under the bottom run of both tracks, like those of soil.
  const double stiffness_npm = 60e3, damping_nspm = 3e3;
  MachineRun run(model, MakePose(Vec3(2, -1, 0.01), 0, 0, 0.7));
  const GroundTools& tools = model.ground_tools;
  int springs = 0;
  double pressed_n = 0;
  for (int step = 0; step < 5000; ++step) {
    springs = 0;
    pressed_n = 0;
    const BodyState base = run.state().links[0];
    Wrench& wrench = run.input.soil.link_wrench[0];
    wrench = Wrench();
    for (const RunningGear& gear : tools.gears) {
      for (const ContactPatch& patch : gear.patches) {
        if (patch.outward_B.z() > -0.999) continue;
        ++springs;
        const Vec3 p_W = base.X_WB * patch.p_B_m;
        const Vec3 v_W = PointVelocity(base, patch.p_B_m);
        if (p_W.z() > 0) continue;
        const Vec3 force_n = Vec3(0, 0, -stiffness_npm * p_W.z()) - damping_nspm * v_W;
        wrench.AddForceAt(force_n, p_W, base.X_WB.translation());
        pressed_n += force_n.z();
      }
    }
    run.Step();
  }
  const BodyState& base = run.state().links[0];
  EXPECT_NEAR(pressed_n, 3500 * kGravity_mps2, 0.5);
  EXPECT_LT(base.v_WB_mps.norm(), 1e-4);
  EXPECT_LT(base.w_WB_radps.norm(), 1e-4);
  // Heave of the springs' centre, on the slew axis; the boom ahead tips it forward.
  EXPECT_NEAR(base.X_WB.translation().z(), -3500 * kGravity_mps2 / (springs * stiffness_npm), 2e-4);
}

TEST(PhysicsWorld, JointsMustStartWithinTheirLimits) {
  MachinePlacement placement = PlaceAtStart(ShippedMachine("tb235"), Pose::Identity());
  placement.q_rad[3] = 0;  // the arm has -155 to -30 deg
  EXPECT_THROW(PhysicsWorld({placement}, {}, kGravity_mps2), InternalError);
}

TEST(PhysicsWorld, TwoMachinesApartMoveAsIfEachWereAlone) {
  const MachineModel excavator = ShippedMachine("tb235"), rover = ShippedMachine("warthog");
  const Pose X_W1 = MakePose(Vec3(0, 0, 5), 0.1, 0, 0), X_W2 = MakePose(Vec3(12, 3, 6), 0, 0.2, 1);
  PhysicsWorld both({PlaceAtStart(excavator, X_W1, "a"), PlaceAtStart(rover, X_W2, "b")}, {},
                    kGravity_mps2);
  MachineRun alone_1(excavator, X_W1), alone_2(rover, X_W2);
  alone_1.input.levers = {0, 0, 0.5, 0, 0.6, -0.4, 0.2, 0};
  alone_2.input.levers = {0.3, -0.3};
  for (int i = 0; i < 300; ++i) {
    both.Step({alone_1.input, alone_2.input}, {}, kStep_s);
    alone_1.Step();
    alone_2.Step();
  }
  EXPECT_EQ(both.machines()[0].q_rad, alone_1.state().q_rad);
  EXPECT_EQ(both.machines()[0].effort_nm, alone_1.state().effort_nm);
  EXPECT_TRUE(both.machines()[1].links[0].X_WB.isApprox(alone_2.state().links[0].X_WB, 0));
}

TEST(PhysicsWorld, TheSameInputsGiveTheSameBits) {
  const MachineModel model = ShippedMachine("tb235");
  const auto run_once = [&] {
    MachineRun run(model, MakePose(Vec3(1, 2, 3), 0.1, 0.2, 0.3));
    run.input.levers = {1, -1, 0.5, 0.2, 0.6, -0.4, 0.2, 0.1};
    run.StepFor(1.0);
    return run.state();
  };
  const MachineState a = run_once(), b = run_once();
  EXPECT_EQ(a.q_rad, b.q_rad);
  EXPECT_EQ(a.effort_nm, b.effort_nm);
  EXPECT_EQ(a.gear_angle_rad, b.gear_angle_rad);
  for (std::size_t i = 0; i < a.links.size(); ++i) {
    EXPECT_EQ(a.links[i].X_WB.matrix(), b.links[i].X_WB.matrix());
    EXPECT_EQ(a.links[i].a_WB_mps2, b.links[i].a_WB_mps2);
  }
}

}  // namespace
}  // namespace tera
