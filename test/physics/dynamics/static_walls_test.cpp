#include <gtest/gtest.h>

#include "physics/machine_fixture.h"

namespace tera {
namespace {

/// A cart of 1 m length on invisible rails: no gravity, pushed along x.
const std::string kStaticWallsCart = R"(
kind: cart
links:
  cart:
    mass_kg: 100
    com_m: [0, 0, 0.5]
    inertia_kgm2: [20, 20, 20]
    collision: [{xyz_m: [0, 0, 0.5], size_m: [1, 0.8, 0.6]}]
)";

/// Position of the cart's nose after 4 s at 60 N, with these triangles nearby.
double NoseAfterPush_m(const SiteWalls& walls) {
  const MachineModel model = MachineFromText(kStaticWallsCart);
  PhysicsWorld world({PlaceAtStart(model, MakePose(Vec3(0, 0.3, 0.2)))}, {}, 0.0, {}, walls);
  MachineInput input;
  input.levers.assign(model.levers.size(), 0.0);
  for (int i = 0; i < 2000; ++i) {
    const BodyState& cart = world.machines()[0].links[0];
    input.soil.link_wrench.assign(model.links.size(), Wrench());
    input.soil.link_wrench[0].AddForceAt(Vec3(60, 0, 0), cart.X_WB * model.links[0].com_B_m,
                                         cart.X_WB.translation());
    world.Step({input}, {}, kStep_s);
  }
  return world.machines()[0].links[0].X_WB.translation().x() + 0.5;
}

TEST(StaticWalls, AWallOfTrianglesStopsAMachineWhicheverWayTheyFace) {
  const std::vector<Vec3> corners = {{2.8, -3, -1}, {2.8, 3, -1}, {2.8, 3, 2}, {2.8, -3, 2}};
  EXPECT_NEAR(NoseAfterPush_m({corners, {0, 1, 2, 0, 2, 3}}), 2.8, 0.05);
  EXPECT_NEAR(NoseAfterPush_m({corners, {0, 2, 1, 0, 3, 2}}), 2.8, 0.05);
}

TEST(StaticWalls, BesideAWallAMachineGoesOn) {
  const std::vector<Vec3> corners = {{2.8, 1.0, -1}, {2.8, 3, -1}, {2.8, 3, 2}, {2.8, 1.0, 2}};
  // 60 N on 100 kg for 4 s: 4.8 m, from 0.5 m on.
  EXPECT_NEAR(NoseAfterPush_m({corners, {0, 1, 2, 0, 2, 3}}), 5.3, 0.02);
}

}  // namespace
}  // namespace tera
