#include "soil/site/soil_catalogue.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "soil/block_fixture.h"
#include "soil/flow/avalanche.h"
#include "soil/flow/grains.h"
#include "soil/soil_fixture.h"
#include "soil/track/plate.h"

namespace tera {
namespace {

using namespace testing_soil;

/// Work of a bucket over a volume of undisturbed soil, 1 kJ/m^3 being 1 kPa.
struct Resistance {
  double of_hole_kpa = 0;    ///< over all that is dug
  double of_filled_kpa = 0;  ///< over the soil that fills the bucket
};

/// The compact excavator's bucket is drawn 0.8 m through level ground at a depth of 0.15 m, which
/// fills it, and curled.
Resistance ResistanceTo(const std::string& soil_name) {
  auto soil = MakeGround("soil: " + soil_name + "\nsize_m: [10, 10]\n");
  GroundTools tools;
  tools.shovels = {CompactBucket()};
  const int machine = soil->AddMachine(tools);
  constexpr double kTipDown_m = 0.78;  // from the pin to the edge
  const double z_m = kTipDown_m - 0.15;
  const BucketPath path({{0.0, {0.3, 0, z_m + 0.3}, 80 * kDeg},
                         {0.6, {0.3, 0, z_m}, 85 * kDeg},
                         {2.5, {-0.5, 0, z_m - 0.02}, 105 * kDeg},
                         {3.5, {-0.7, 0, z_m + 0.05}, 165 * kDeg}});
  double work_j = 0, load_kg = 0;
  RunBucket(
      soil.get(), machine, path, [&](double, const BodyState& body, const SoilReaction& reaction) {
        const Wrench& wrench = reaction.link_wrench[0];
        work_j -= kStep_s *
                  (wrench.force_W_n.dot(body.v_WB_mps) + wrench.torque_W_nm.dot(body.w_WB_radps));
        load_kg = reaction.shovel_load[0].mass_kg;
      });
  const TerrainSurface& ground = soil->surface();
  double hole_m3 = 0;
  for (double x = -2.5; x < 2.5; x += 0.05) {
    for (double y = -1; y < 1; y += 0.05) {
      hole_m3 -= std::min(0.0, ground.HeightAt(x, y)) * 0.05 * 0.05;
    }
  }
  return {1e-3 * work_j / hole_m3, 1e-3 * work_j * Shipped(soil_name).bank_density_kgpm3 / load_kg};
}

// Specific resistances to digging with face shovels and backhoes, cutting and filling together, by
// class of soil (Dombrovskij, Ekskavatory, 1969; as reprinted in textbooks since): I sand, sandy
// loam, soft or loosened soil 18 to 80 kPa; III hard loam, medium clay 160 to 280; IV stiff clay
// 220 to 400.
TEST(SoilCatalogue, EachSoilResistsDiggingAsItsClassDoes) {
  struct Class {
    const char* soil;
    double least_kpa, most_kpa;
  };
  for (const auto& [soil, least_kpa, most_kpa] :
       {Class{"clay", 18, 80}, Class{"sand", 18, 80}, Class{"wet_sand", 18, 80},
        Class{"dirt", 18, 80}, Class{"hard_loam", 160, 280}, Class{"stiff_clay", 220, 400}}) {
    const Resistance resistance = ResistanceTo(soil);
    EXPECT_GT(resistance.of_hole_kpa, least_kpa) << soil;
    EXPECT_LT(resistance.of_filled_kpa, most_kpa) << soil;
    RecordProperty(soil, fmt::format("{:.0f} to {:.0f} kPa", resistance.of_hole_kpa,
                                     resistance.of_filled_kpa));
  }
}

// Fine and medium gravel is of class II, 70 to 180 kPa, above sand, loam and loosened soil of class
// I (the same). Sand as it was poured is looser than sand as it lies.
TEST(SoilCatalogue, SpecificEnergyOfDiggingHasTheOrderOfThePublishedClasses) {
  const std::vector<std::string> order = {"loose",  "loose_sand", "sand",      "dirt",
                                          "gravel", "hard_loam",  "stiff_clay"};
  Resistance before;
  for (const std::string& soil : order) {
    const Resistance resistance = ResistanceTo(soil);
    EXPECT_GT(resistance.of_hole_kpa, 1.05 * before.of_hole_kpa) << soil;
    EXPECT_GT(resistance.of_filled_kpa, 1.05 * before.of_filled_kpa) << soil;
    before = resistance;
    RecordProperty(soil, fmt::format("{:.0f} to {:.0f} kPa", resistance.of_hole_kpa,
                                     resistance.of_filled_kpa));
  }
}

/// Volume of the heap that a hole of 0.5 m x 0.5 m x 0.3 m makes, over that of the hole.
double HeapOverHole(const std::string& soil_name) {
  const SoilType soil = Shipped(soil_name);
  Columns hole = LevelColumns(soil, 0.05, 61), heap = LevelColumns(soil, 0.05, 61);
  constexpr double kDepth_m = 0.3;
  SpoilMix dug;
  double hole_m3 = 0;
  for (int j = 25; j < 35; ++j) {
    for (int i = 25; i < 35; ++i) {
      hole.Cut(hole.Touch(i, j), -kDepth_m, &dug);
      hole_m3 -= hole.TopAt(i, j) * hole.area_m2();
    }
  }
  heap.DepositAt(30, 30, dug);
  Avalanche avalanche(heap.soils());
  Grains clods(heap.soils(), 7);
  for (int k = 0; k < 2000; ++k) avalanche.Flow(kStep_s, &heap, &clods);
  double heap_m3 = 0;
  for (int j = 0; j < heap.ny(); ++j) {
    for (int i = 0; i < heap.nx(); ++i) heap_m3 += heap.TopAt(i, j) * heap.area_m2();
  }
  return heap_m3 / hole_m3;
}

// Dry sand and dry gravel fill 0.89 of their heap as they lie (load factors of Caterpillar's
// Performance Handbook, table of weights of materials). Sand that was poured lies as it is poured.
TEST(SoilCatalogue, AHeapOfSandOrGravelIsAnEighthLargerThanItsHole) {
  EXPECT_NEAR(HeapOverHole("sand"), 1 / 0.89, 0.01);
  EXPECT_NEAR(HeapOverHole("gravel"), 1 / 0.89, 0.01);
  EXPECT_NEAR(HeapOverHole("loose_sand"), 1, 0.001);
}

/// Depth to which two tracks sink that press on clay with a mean pressure.
double SinkageInClay_m(double pressure_pa) {
  Block block("size_m: [6, 4]\nsoil: clay\n", Vec2(0, 0));
  block.mass_kg = pressure_pa * 2 * kLength_m * kWidth_m / kStandardGravity_mps2;
  block.Stand(3000);
  return -block.links[0].X_WB.translation().z();
}

// Prandtl's strip on soil without friction bears (2 + pi) c: 21.3 kPa for a cohesion of 4.14 kPa.
// The weight of the soil beside it adds 0.9 kPa at 5 cm. Its own weight and the friction left
// before full saturation add less than two fifths. A machine of 3.5 t on its tracks presses with
// 36 kPa.
TEST(SoilCatalogue, VerySoftClayBearsWhatItsCohesionAllows) {
  const SoilType clay = Shipped("clay");
  ContactPatch track;
  track.length_m = kLength_m;
  track.width_m = kWidth_m;
  const double borne_pa = Plate(clay, track).Pressure_pa(0.05);
  EXPECT_GT(borne_pa, 22.2e3);
  EXPECT_LT(borne_pa, 1.4 * 22.2e3);
  EXPECT_LT(SinkageInClay_m(20e3), 0.01);
  EXPECT_GT(SinkageInClay_m(36e3), 0.05);
}

}  // namespace
}  // namespace tera
