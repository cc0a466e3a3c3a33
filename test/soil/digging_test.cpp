#include "soil/digging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "soil/shovel_shape.h"
#include "soil_fixture.h"

namespace tera {
namespace {

using namespace testing_soil;

int AddBucket(Soil* soil) {
  GroundTools tools;
  tools.shovels = {CompactBucket()};
  return soil->AddMachine(tools);
}

TEST(ShovelShape, VerticalLineCrossesTheTurnedBucketWhereItsCornersAre) {
  const ShovelShape shape(CompactBucket());
  // Mouth upwards (pitch 180 deg), yawed and lifted: the bottom of the shell, at z_B = 0.42, is the
  // lowest point under x_B = 0.30.
  const Pose X_WB =
      MakePose(Vec3(1, 2, 3), RotationFromRpy(0, 0, 0.7) * RotationFromRpy(0, kPi, 0));
  const Vec3 p_W = X_WB * Vec3(0.30, 0.1, 0.42);
  const auto crossing = shape.VerticalCrossing(X_WB, p_W.x(), p_W.y());
  ASSERT_TRUE(crossing);
  EXPECT_NEAR(crossing->low_m, 3 - 0.42, 1e-9);
  EXPECT_FALSE(crossing->through_mouth);
  // The mouth runs from z_B = -0.03 at x_B = 0.09 to 0 at 0.78.
  EXPECT_NEAR(crossing->high_m, 3 + 0.03 * (0.78 - 0.30) / 0.69, 1e-9);
  const Vec3 beside_W = X_WB * Vec3(0.30, 0.31, 0);
  EXPECT_FALSE(shape.VerticalCrossing(X_WB, beside_W.x(), beside_W.y()));
}

TEST(ShovelShape, HoldsItsStruckVolumeLevelAndNothingUpsideDown) {
  const ShovelShape shape(CompactBucket());
  const Vec3 mouth = shape.mouth_normal_B();
  // Repose 0 (a liquid) in a level bucket: the struck capacity. The slices resolve it to 1 %.
  EXPECT_NEAR(shape.HoldFor(mouth, 0, 1).volume_m3, 0.11, 0.0011);
  EXPECT_GT(shape.HoldFor(mouth, 35 * kDeg, 1).volume_m3, 0.12);  // heaped
  EXPECT_EQ(shape.HoldFor(-mouth, 35 * kDeg, 1).volume_m3, 0);
  // A level fill's centre lies inside, below the mouth.
  const Vec3 com = shape.HoldFor(mouth, 0, 0.05).com_B_m;
  EXPECT_GT(com.z(), 0.15);
  EXPECT_LT(com.z(), 0.42);
}

TEST(Digging, CycleDigsCarriesDumpsAndLosesNothing) {
  auto soil = MakeSite("soil: dirt\nrelief: {amplitude_m: 0.02}\n");
  const int machine = AddBucket(soil.get());
  double carried_kg = 0, left_kg = 0;
  for (int cycle = 0; cycle < 3; ++cycle) {
    RunBucket(soil.get(), machine, DigCycle(0.15 + 0.1 * cycle),
              [&](double t_s, const BodyState&, const SoilReaction& reaction) {
                const SoilReaction::Load& load = reaction.shovel_load[0];
                if (std::abs(t_s - 5.9) < 1e-6 && cycle == 0) carried_kg = load.mass_kg;
                if (std::abs(t_s - 8.4) < 1e-6) left_kg = load.mass_kg;
              });
  }
  // A heaped bucket of 0.11 m^3 struck holds 0.11 to 0.16 m^3 of soil at 1340 kg/m^3.
  EXPECT_GT(carried_kg, 100);
  EXPECT_LT(carried_kg, 0.16 * 1340);
  EXPECT_LT(left_kg, 1);
  const MassLedger ledger = soil->ledger();
  EXPECT_NEAR(ledger.total_kg() / ledger.shifted_kg, 0, 1e-9);
  EXPECT_EQ(ledger.outside_kg, 0);
  const TerrainSurface& ground = soil->surface();
  EXPECT_LT(ground.HeightAt(-0.3, 0), -0.15);  // a trench
  double pile_m = 0;                           // where it was dumped, and as far as it flew
  for (double x = -2.2; x < -0.9; x += 0.05) pile_m = std::max(pile_m, ground.HeightAt(x, 2.5));
  EXPECT_GT(pile_m, 0.15);
}

TEST(Digging, NothingWhenLifted) {
  auto soil = MakeSite("soil: dirt\n");
  const int machine = AddBucket(soil.get());
  const BucketPath path({{0, {0, 0, 1.0}, 1.5}, {1, {1, 0.5, 1.5}, 2.5}});
  RunBucket(soil.get(), machine, path, [](double, const BodyState&, const SoilReaction& reaction) {
    EXPECT_EQ(reaction.link_wrench[0].force_W_n, Vec3::Zero());
    EXPECT_EQ(reaction.link_wrench[0].torque_W_nm, Vec3::Zero());
    EXPECT_EQ(reaction.shovel_load[0].mass_kg, 0);
  });
}

/// Mean backward force while an edge is dragged towards -x (turned by yaw) at a depth.
double DragForce_n(double depth_m, double yaw_rad, double pitch_rad = 100 * kDeg,
                   const Shovel& bucket = CompactBucket()) {
  auto soil = MakeSite("soil: dirt\nsize_m: [10, 10]\n");
  GroundTools tools;
  tools.shovels = {bucket};
  const int machine = soil->AddMachine(tools);
  const double z = 0.78 * std::sin(pitch_rad) - depth_m;
  const BucketPath path({{0, {0.5, 0, z}, pitch_rad}, {1, {-0.1, 0, z}, pitch_rad}}, yaw_rad);
  double sum_n = 0;
  int count = 0;
  RunBucket(soil.get(), machine, path,
            [&](double t_s, const BodyState& body, const SoilReaction& reaction) {
              if (t_s < 0.3) return;
              sum_n -= reaction.link_wrench[0].force_W_n.dot(body.v_WB_mps.normalized());
              ++count;
            });
  return sum_n / count;
}

TEST(Digging, ForceGrowsWithDepthWhicheverWayTheMachineFaces) {
  for (const double yaw_rad : {0.0, 0.6}) {
    double last_n = 0;
    for (const double depth_m : {0.05, 0.10, 0.15, 0.20}) {
      const double force_n = DragForce_n(depth_m, yaw_rad);
      EXPECT_GT(force_n, last_n) << depth_m;
      last_n = force_n;
    }
    EXPECT_GT(last_n, 2e3);  // 0.6 m wide, 0.2 m deep in dirt: a few kN
    EXPECT_LT(last_n, 15e3);
  }
}

TEST(Digging, ForceOpposesMotionInEveryDirection) {
  const Stream random(3, "test/directions");
  for (int trial = 0; trial < 100; ++trial) {
    auto soil = MakeSite("soil: dirt\nsize_m: [6, 6]\n");
    const int machine = AddBucket(soil.get());
    const auto uniform = [&](int lane, double low, double high) {
      return low + (high - low) * random.Uniform(trial, lane);
    };
    const Vec3 v(uniform(0, -1, 1), uniform(1, -0.2, 0.2), uniform(2, -0.5, 0.2));
    const double pitch_rad = uniform(3, 30, 190) * kDeg, z = uniform(4, 0.3, 0.75);
    const BucketPath path(
        {{0, Vec3(0, 0, z), pitch_rad}, {0.3, Vec3(0, 0, z) + 0.3 * v, pitch_rad}},
        uniform(5, -3, 3));
    RunBucket(soil.get(), machine, path,
              [&](double t_s, const BodyState& body, const SoilReaction& reaction) {
                const Vec3 force_n = reaction.link_wrench[0].force_W_n;
                ASSERT_TRUE(force_n.allFinite());
                ASSERT_LT(force_n.norm(), 3e5);
                if (t_s < 0.05) return;  // started inside the ground: elastic relief
                ASSERT_LE(force_n.dot(body.v_WB_mps), 1.0) << "trial " << trial << " t " << t_s;
              });
  }
}

TEST(Digging, TeethPierceFirstAndTheEdgeFollowsTheirLengthLater) {
  Shovel toothed = CompactBucket();
  toothed.tooth_length_m = 0.15;
  Shovel flush = toothed;
  flush.tooth_length_m = 0;
  Shovel toothless = flush;
  toothless.teeth = 0;
  // At a pitch of 60 degrees the floor at the edge falls by 0.75 of its length, so that teeth of 15
  // cm alone are in the ground at 8 cm. Six of them, 60 x 20 mm, have the area of 600 mm of a 12 mm
  // edge.
  const auto force_n = [](const Shovel& bucket) {
    return DragForce_n(0.08, 0.3, 60 * kDeg, bucket);
  };
  EXPECT_NEAR(force_n(toothed), force_n(toothless), 1e-6);
  EXPECT_GT(force_n(flush), force_n(toothed) + 50);
  Shovel shorter = toothed;
  shorter.tooth_length_m = 0.05;
  EXPECT_GT(force_n(shorter), force_n(toothed) + 20);
  EXPECT_GT(force_n(flush), force_n(shorter) + 10);
}

TEST(Digging, BladePushesAWindrowAheadAndCarriesNothing) {
  auto soil = MakeSite("soil: dirt\nsize_m: [12, 8]\n");
  GroundTools tools;
  tools.shovels = {CompactBlade()};
  const int machine = soil->AddMachine(tools);
  // Edge 5 cm deep, driven forward 2 m.
  const BucketPath path({{0, {-2, 0, 0.25}, 0}, {4, {0, 0, 0.25}, 0}});
  double force_n = 0;
  RunBucket(soil.get(), machine, path, [&](double, const BodyState&, const SoilReaction& reaction) {
    EXPECT_EQ(reaction.shovel_load[0].mass_kg, 0);
    force_n = reaction.link_wrench[0].force_W_n.x();
  });
  EXPECT_LT(force_n, -1e3);
  const TerrainSurface& ground = soil->surface();
  EXPECT_NEAR(ground.HeightAt(-0.5, 0), -0.05, 0.02);  // the cut behind
  EXPECT_GT(ground.HeightAt(0.75, 0), 0.08);           // the windrow ahead
  const MassLedger ledger = soil->ledger();
  EXPECT_NEAR(ledger.total_kg() / ledger.shifted_kg, 0, 1e-9);
}

TEST(Digging, BucketPressedOnTheGroundBearsAMachineAndHolds) {
  // Lying on the bottom of its shell (mouth up) under 15 kN, free to move vertically.
  auto soil = MakeSite("soil: dirt\nsize_m: [6, 6]\n");
  const int machine = AddBucket(soil.get());
  constexpr double kMass_kg = 1500;
  std::vector<BodyState> links(1);
  links[0].X_WB = MakePose(Vec3(0.1, 0.2, 0.43), 0, kPi, 0.4);
  GroundToolsMotion motion;
  motion.links = &links;
  double z_after_2s_m = 0;
  for (int k = 0; k < 2000; ++k) {
    const SoilReaction reaction = soil->Act(machine, motion, kStep_s);
    const double a_mps2 = reaction.link_wrench[0].force_W_n.z() / kMass_kg - kStandardGravity_mps2;
    links[0].v_WB_mps.z() += kStep_s * a_mps2;
    links[0].X_WB.translation() += kStep_s * links[0].v_WB_mps;
    if (k == 1000) z_after_2s_m = links[0].X_WB.translation().z();
  }
  EXPECT_NEAR(links[0].X_WB.translation().z(), z_after_2s_m, 1e-3);  // no creep
  EXPECT_GT(z_after_2s_m, 0.42 - 0.25);
  EXPECT_LT(std::abs(links[0].v_WB_mps.z()), 5e-3);
}

TEST(Digging, SameSeedSameMotionSameBytes) {
  const auto run = [] {
    auto soil = MakeSite("soil: dirt\nrelief: {amplitude_m: 0.1}\n");
    const int machine = AddBucket(soil.get());
    RunBucket(soil.get(), machine, DigCycle(0.2), [](double, const BodyState&, const auto&) {});
    std::vector<float> heights;
    const TerrainSurface& ground = soil->surface();
    for (int j = 0; j < ground.ny; ++j) {
      for (int i = 0; i < ground.nx; ++i) heights.push_back(ground.height_m(i, j));
    }
    return heights;
  };
  EXPECT_EQ(run(), run());
}

TEST(Digging, QuietTilesKeepTheirVersion) {
  auto soil = MakeSite("soil: dirt\n");
  const int machine = AddBucket(soil.get());
  RunBucket(soil.get(), machine, DigCycle(), [](double, const BodyState&, const auto&) {});
  const TerrainSurface& ground = soil->surface();
  int changed = 0;
  for (int b = 0; b < ground.tiles_y(); ++b) {
    for (int a = 0; a < ground.tiles_x(); ++a) changed += ground.tile_version(a, b) > 1;
  }
  EXPECT_GE(changed, 2);
  EXPECT_LE(changed, 8);  // of 256, 2.5 m each: a dig and a pile 2.5 m apart
}

}  // namespace
}  // namespace tera
