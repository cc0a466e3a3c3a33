#include <gtest/gtest.h>

#include "physics/machine_fixture.h"

namespace tera {
namespace {

/// A cart of 1 m length on invisible rails: no gravity, pushed along x.
const std::string kCart = R"(
kind: cart
links:
  cart:
    mass_kg: 100
    com_m: [0, 0, 0.5]
    inertia_kgm2: [20, 20, 20]
    collision: [{xyz_m: [0, 0, 0.5], size_m: [1, 0.8, 0.6]}]
)";

ObstacleBody Wall(const Vec3& p_W) {
  ObstacleBody wall{.name = "wall"};
  wall.collision = {{.X_BG = MakePose(Vec3(0, 0, 1)), .size_m = Vec3(0.4, 6, 2)}};
  wall.state.X_WB = MakePose(p_W);
  return wall;
}

MachineInput Push(const MachineModel& model, const BodyState& body, const Vec3& force_n) {
  MachineInput input;
  input.levers.assign(model.levers.size(), 0.0);
  input.soil.link_wrench.resize(model.links.size());
  input.soil.link_wrench[0].AddForceAt(force_n, body.X_WB * model.links[0].com_B_m,
                                       body.X_WB.translation());
  return input;
}

TEST(Obstacles, AWallStopsAMachine) {
  const MachineModel model = MachineFromText(kCart);
  const ObstacleBody wall = Wall(Vec3(3, 0, 0));
  PhysicsWorld world({PlaceAtStart(model, MakePose(Vec3(0, 0.3, 0.2)))}, {wall}, 0.0);
  double fastest_mps = 0;
  for (int i = 0; i < 3000; ++i) {
    const BodyState& cart = world.machines()[0].links[0];
    world.Step({Push(model, cart, Vec3(60, 0, 0))}, {wall.state}, kStep_s);
    fastest_mps = std::max(fastest_mps, cart.v_WB_mps.x());
  }
  // Its nose, 0.5 m ahead, rests on the wall's face at 2.8 m.
  EXPECT_GT(fastest_mps, 1.0);
  EXPECT_NEAR(world.machines()[0].links[0].X_WB.translation().x(), 2.3, 0.03);
  EXPECT_NEAR(world.machines()[0].links[0].v_WB_mps.x(), 0, 0.01);
}

TEST(Obstacles, AContactHasTheForceThatHoldsTheMachine) {
  const MachineModel model = MachineFromText(kCart);
  const ObstacleBody wall = Wall(Vec3(3, 0, 0));
  PhysicsWorld world({PlaceAtStart(model, MakePose(Vec3(1.5, 0.3, 0.2)))}, {wall}, 0.0);
  for (int i = 0; i < 3000; ++i) {
    world.Step({Push(model, world.machines()[0].links[0], Vec3(60, 0, 0))}, {wall.state}, kStep_s);
    if (i == 0) {
      EXPECT_TRUE(world.contacts().empty());
    }
  }
  ASSERT_EQ(world.contacts().size(), 1u);
  const BodyContact& contact = world.contacts()[0];
  const bool is_a = contact.a.kind == BodyContact::Kind::kMachine;
  EXPECT_EQ((is_a ? contact.b : contact.a).kind, BodyContact::Kind::kObstacle);
  const Vec3 on_cart_n = is_a ? contact.force_W_n : Vec3(-contact.force_W_n);
  EXPECT_LT((on_cart_n - Vec3(-60, 0, 0)).norm(), 1.0);
  EXPECT_NEAR(contact.p_W_m.x(), 2.8, 0.03);  // the wall's face
}

TEST(Obstacles, AMovingObstaclePushesAMachine) {
  const MachineModel model = MachineFromText(kCart);
  ObstacleBody wall = Wall(Vec3(-1, 0, 0));
  PhysicsWorld world({PlaceAtStart(model, MakePose(Vec3(0, 0.3, 0.2)))}, {wall}, 0.0);
  for (int i = 1; i <= 1000; ++i) {
    wall.state.X_WB = MakePose(Vec3(-1 + 0.5 * i * kStep_s, 0, 0));
    world.Step({Push(model, world.machines()[0].links[0], Vec3::Zero())}, {wall.state}, kStep_s);
  }
  // The wall's face came to 0.2 m after 2 s at 0.5 m/s; the cart's tail is ahead of it.
  EXPECT_GE(world.machines()[0].links[0].X_WB.translation().x(), 0.7 - 0.03);
  EXPECT_GE(world.machines()[0].links[0].v_WB_mps.x(), 0.45);
}

TEST(Obstacles, MachinesCollideWithEachOther) {
  const MachineModel model = MachineFromText(kCart);
  PhysicsWorld world({PlaceAtStart(model, MakePose(Vec3(0, 0, 0)), "a"),
                      PlaceAtStart(model, MakePose(Vec3(2, 0, 0)), "b")},
                     {}, 0.0);
  for (int i = 0; i < 2000; ++i) {
    const BodyState& a = world.machines()[0].links[0];
    const BodyState& b = world.machines()[1].links[0];
    world.Step({Push(model, a, Vec3(60, 0, 0)), Push(model, b, Vec3::Zero())}, {}, kStep_s);
  }
  const BodyState& a = world.machines()[0].links[0];
  const BodyState& b = world.machines()[1].links[0];
  EXPECT_GE(b.X_WB.translation().x() - a.X_WB.translation().x(), 1.0 - 0.03);
  EXPECT_GT(b.v_WB_mps.x(), 0.3);
  // Momentum of both together is the impulse of the push: 60 N for 4 s.
  EXPECT_NEAR(100 * (a.v_WB_mps.x() + b.v_WB_mps.x()), 240, 1.0);
}

TEST(Obstacles, PartsOfOneMachineDoNotCollide) {
  // The bucket is folded through the arm's boxes and nothing moves.
  const MachineModel model = ShippedMachine("tb235");
  MachineRun run(model, Pose::Identity(), 0.0);
  run.StepFor(0.5);
  for (const BodyState& link : run.state().links) EXPECT_LT(link.v_WB_mps.norm(), 1e-9);
}

}  // namespace
}  // namespace tera
