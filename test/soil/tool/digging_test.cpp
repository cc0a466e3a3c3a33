#include "soil/tool/digging.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>
#include <utility>

#include "core/random.h"
#include "soil/soil_fixture.h"

namespace tera {
namespace {

using namespace testing_soil;

TEST(Digging, CycleDigsCarriesDumpsAndLosesNothing) {
  auto soil = MakeGround("soil: dirt\nrelief: {amplitude_m: 0.02}\n");
  const int machine = AddCompactBucket(soil.get());
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
  auto soil = MakeGround("soil: dirt\n");
  const int machine = AddCompactBucket(soil.get());
  const BucketPath path({{0, {0, 0, 1.0}, 1.5}, {1, {1, 0.5, 1.5}, 2.5}});
  RunBucket(soil.get(), machine, path, [](double, const BodyState&, const SoilReaction& reaction) {
    EXPECT_EQ(reaction.link_wrench[0].force_W_n, Vec3::Zero());
    EXPECT_EQ(reaction.link_wrench[0].torque_W_nm, Vec3::Zero());
    EXPECT_EQ(reaction.shovel_load[0].mass_kg, 0);
  });
}

/// Mean backward force while an edge is dragged towards -x (turned by yaw) at a depth.
double DragForce_n(double depth_m, double yaw_rad) {
  constexpr double pitch_rad = 100 * kDeg;
  auto soil = MakeGround("soil: dirt\nsize_m: [10, 10]\n");
  const int machine = AddCompactBucket(soil.get());
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
    auto soil = MakeGround("soil: dirt\nsize_m: [6, 6]\n");
    const int machine = AddCompactBucket(soil.get());
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

TEST(Digging, BucketPressedOnTheGroundBearsAMachineAndHolds) {
  // Lying on the bottom of its shell (mouth up) under 15 kN, free to move vertically.
  auto soil = MakeGround("soil: dirt\nsize_m: [6, 6]\n");
  const int machine = AddCompactBucket(soil.get());
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

TEST(Digging, TwoBucketsOfOneMachineCarryTheirOwnSoils) {
  auto soil = MakeGround(
      "soils: [dirt, gravel]\nstrips:\n  - {soil: gravel, axis: y, from_m: 1, to_m: 20}\n");
  GroundTools tools;
  tools.shovels = {CompactBucket(), CompactBucket()};
  tools.shovels[1].link = 1;
  tools.shovels[1].width_m = 0.4;
  const int machine = soil->AddMachine(tools);
  const BucketPath path({{0.0, {0.3, 0, 1.3}, 80 * kDeg},
                         {1.0, {0.3, 0, 0.6}, 85 * kDeg},
                         {2.5, {-0.5, 0, 0.58}, 105 * kDeg},
                         {3.5, {-0.7, 0, 0.65}, 165 * kDeg},
                         {4.5, {-0.7, 0, 1.6}, 180 * kDeg},
                         {5.5, {-0.7, 0, 1.6}, 180 * kDeg}});
  SoilReaction last;
  for (int k = 0; k * kStep_s < path.end_s(); ++k) {
    std::vector<BodyState> links(2, path.At(k * kStep_s));
    links[1].X_WB.translation().y() += 3;  // in the gravel
    GroundToolsMotion motion;
    motion.links = &links;
    last = soil->Act(machine, motion, kStep_s);
    soil->Flow(kStep_s);
  }
  ASSERT_EQ(last.shovel_load.size(), 2u);
  const SoilReaction::Load &a = last.shovel_load[0], &b = last.shovel_load[1];
  EXPECT_GT(a.mass_kg, 80);
  EXPECT_GT(b.mass_kg, 40);
  EXPECT_GT(a.volume_m3, 1.05 * b.volume_m3);  // 0.6 and 0.4 m wide
  EXPECT_EQ(a.soil_kg, (std::vector<double>{a.mass_kg, 0}));
  EXPECT_EQ(b.soil_kg, (std::vector<double>{0, b.mass_kg}));
  EXPECT_NEAR(a.mass_kg / a.volume_m3, 1474 / 1.1, 1);
  EXPECT_NEAR(b.mass_kg / b.volume_m3, 1690 / 1.12, 1);
  EXPECT_NEAR(soil->ledger().carried_kg, a.mass_kg + b.mass_kg, 1e-9);
}

TEST(Digging, ATrenchThroughALayerBringsUpBothSoilsByTheirThickness) {
  auto soil = MakeGround(
      "soils: [sand, gravel]\nlayers:\n  - {soil: sand, from_m: 0, to_m: 0.1}\n"
      "  - {soil: gravel, from_m: 0.1}\n");
  const int machine = AddCompactBucket(soil.get());
  SoilReaction::Load load;
  // Straight ahead 0.2 m deep, until it holds some 0.06 m^3: as much of one as of the other.
  const BucketPath path({{0, {0.5, 0, 0.58}, 90 * kDeg}, {2, {0.0, 0, 0.58}, 90 * kDeg}});
  RunBucket(soil.get(), machine, path, [&](double, const BodyState&, const SoilReaction& r) {
    if (r.shovel_load[0].volume_m3 < 0.06) load = r.shovel_load[0];
  });
  ASSERT_GT(load.mass_kg, 50);
  EXPECT_NEAR(load.soil_kg[0] / load.mass_kg, 0.5, 0.15);
  EXPECT_NEAR(load.soil_kg[0] + load.soil_kg[1], load.mass_kg, 1e-9);
}

/// Soil that stays in the bucket after a dig and a dump.
double LeftAfterDump_kg(const std::string& soil_name) {
  auto soil = MakeGround("soil: " + soil_name + "\n");
  const int machine = AddCompactBucket(soil.get());
  double left_kg = 0;
  RunBucket(soil.get(), machine, DigCycle(0.25),
            [&](double t_s, const BodyState&, const SoilReaction& reaction) {
              if (t_s < 8.45) left_kg = reaction.shovel_load[0].mass_kg;
            });
  return left_kg;
}

TEST(Digging, StickySoilLeavesALayerInTheBucket) {
  EXPECT_EQ(LeftAfterDump_kg("dirt"), 0);
  // Adhesion of 300 Pa carries 300 / 9.81 kg on each square metre of the inside. The inside is 0.6
  // m times 1.1 m of floor and back, less the teeth, and two sides of 0.2 m^2.
  EXPECT_NEAR(LeftAfterDump_kg("wet_sand") / (300 / 9.81 * 1.0), 1, 0.2);
}

TEST(Digging, ClayFallsOutOfABucketWhoseMouthLooksDownButForAFewCentimetres) {
  // It is dug as clods that weigh 1790 / 1.4 kg/m^3. A layer of 1 to 3 cm on the square metre of
  // the inside has to be scraped off with a shovel. It is less than a third of the 0.11 m^3 struck.
  const double left_kg = LeftAfterDump_kg("clay");
  EXPECT_GT(left_kg, 0.01 * 1279);
  EXPECT_LT(left_kg, 0.03 * 1279);
  EXPECT_LT(left_kg, 0.11 * 1279 / 3);
}

TEST(Digging, AHeapedBucketSpillsWhenItIsSlewedHard) {
  const auto carried_kg = [](double sideways_mps2) {
    auto soil = MakeGround("soil: dirt\n");
    const int machine = AddCompactBucket(soil.get());
    const BucketPath path = DigCycle(0.25);
    double carried_kg = 0;
    const int steps = static_cast<int>(std::lround(5.8 / kStep_s));
    for (int k = 0; k < steps; ++k) {
      const double t_s = k * kStep_s;
      std::vector<BodyState> links = {path.At(t_s)};
      if (t_s > 4.6) links[0].a_WB_mps2.y() = sideways_mps2;
      GroundToolsMotion motion;
      motion.links = &links;
      carried_kg = soil->Act(machine, motion, kStep_s).shovel_load[0].mass_kg;
      soil->Flow(kStep_s);
    }
    return carried_kg;
  };
  const double calm_kg = carried_kg(0);
  EXPECT_GT(calm_kg, 100);
  EXPECT_GT(carried_kg(1), 0.85 * calm_kg);
  // The state is that of a tilt by 55 deg, past the repose of 37. The surface falls from the lower
  // side wall by 18 deg, or 0.1 m at mean over 0.6 m.
  EXPECT_LT(carried_kg(14), 0.85 * calm_kg);
}

TEST(Digging, ABucketDeepInTheGroundThrowsUpNoNeedles) {
  // Pushed about at random, up to 1.5 m/s, with its edge up to 1.2 m deep.
  const Stream random(11, "test/needles");
  double highest_m = 0;
  for (int trial = 0; trial < 10; ++trial) {
    auto soil = MakeGround("soil: dirt\nsize_m: [6, 6]\n");
    const int machine = AddCompactBucket(soil.get());
    std::vector<BucketPlace> places = {{0, {0, 0, 0.9}, 90 * kDeg}};
    for (int n = 1; n <= 4; ++n) {
      const auto uniform = [&](int lane, double low, double high) {
        return low + (high - low) * random.Uniform(trial, 10 * n + lane);
      };
      places.push_back({0.5 * n,
                        {uniform(0, -0.5, 0.5), uniform(1, -0.5, 0.5), uniform(2, -0.4, 0.4)},
                        uniform(3, 40, 180) * kDeg});
    }
    int step = 0;
    RunBucket(soil.get(), machine, BucketPath(places, 0.3 * trial),
              [&](double, const BodyState& body, const SoilReaction&) {
                if (++step % 5 != 0) return;
                const Vec2 p_W = body.X_WB.translation().head<2>();
                for (double x = -1.3; x <= 1.3; x += 0.05) {
                  for (double y = -1.3; y <= 1.3; y += 0.05) {
                    const Vec2 there = p_W + Vec2(x, y);
                    highest_m = std::max(highest_m, soil->surface().HeightAt(there.x(), there.y()));
                  }
                }
              });
  }
  // The shovel displaces 0.15 m^3 at a time. Heaped up as a cone at repose this is 0.43 m high. It
  // comes to lie on the earlier heaps. Needles are metres high.
  RecordProperty("highest_m", fmt::format("{:.2f}", highest_m));
  EXPECT_LT(highest_m, 0.7);
}

/// Volume of the ground above its level, and below.
std::pair<double, double> RaisedAndLowered_m3(const TerrainSurface& ground) {
  double raised_m3 = 0, lowered_m3 = 0;
  for (int j = 0; j < ground.ny; ++j) {
    for (int i = 0; i < ground.nx; ++i) {
      const double m3 = ground.at(i, j).height_m * ground.cell_m * ground.cell_m;
      (m3 > 0 ? raised_m3 : lowered_m3) += std::abs(m3);
    }
  }
  return {raised_m3, lowered_m3};
}

TEST(Digging, ABuriedBucketHeavesNoMoreThanItSweeps) {
  // Pressed down to 1.2 m, its back is pushed 0.6 m on: it is 0.69 m high, and 0.6 m wide, or 0.65
  // m of cells. The half metre of ground over it stays where it is, or falls behind it.
  auto soil = MakeGround(
      "size_m: [6, 6]\nsoil: dirt_1\n"
      "custom_soils: [{preset: tera:config/soils/dirt.yaml, name: dirt_1, swell: 1}]\n");
  const int machine = AddCompactBucket(soil.get());
  const auto run = [&](const Vec3& from_m, const Vec3& to_m) {
    RunBucket(soil.get(), machine, BucketPath({{0, from_m, 90 * kDeg}, {2, to_m, 90 * kDeg}}),
              [](double, const BodyState&, const SoilReaction&) {});
    return RaisedAndLowered_m3(soil->surface()).first;
  };
  const double pressed_m3 = run({0, 0, 0.9}, {0, 0, -0.42});
  const double pushed_m3 = run({0, 0, -0.42}, {0.6, 0, -0.42});
  const double swept_m3 = 0.69 * 0.65 * 0.6;
  RecordProperty("pressed_pushed_swept_m3",
                 fmt::format("{:.3f} {:.3f} {:.3f}", pressed_m3, pushed_m3, swept_m3));
  EXPECT_GT(pushed_m3 - pressed_m3, 0.5 * swept_m3);
  EXPECT_LT(pushed_m3 - pressed_m3, 1.1 * swept_m3);
  EXPECT_NEAR(soil->ledger().total_kg(), 0, 1e-9);
}

TEST(Digging, SameSeedSameMotionSameBytes) {
  const auto run = [] {
    auto soil = MakeGround("soil: dirt\nrelief: {amplitude_m: 0.1}\n");
    const int machine = AddCompactBucket(soil.get());
    RunBucket(soil.get(), machine, DigCycle(0.2), [](double, const BodyState&, const auto&) {});
    std::vector<float> heights;
    const TerrainSurface& ground = soil->surface();
    for (int j = 0; j < ground.ny; ++j) {
      for (int i = 0; i < ground.nx; ++i) heights.push_back(ground.height_m(i, j));
    }
    return heights;
  };
  const std::vector<float> alone = run();
  EXPECT_EQ(run(), alone);
  // And beside another one on a second thread.
  std::vector<float> beside;
  std::thread other([&] { beside = run(); });
  EXPECT_EQ(run(), alone);
  other.join();
  EXPECT_EQ(beside, alone);
}

TEST(Digging, QuietTilesKeepTheirVersion) {
  auto soil = MakeGround("soil: dirt\n");
  const int machine = AddCompactBucket(soil.get());
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
