#include "soil/columns/ground_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <numeric>

#include "core/error.h"
#include "soil/site/geotiff_fixture.h"
#include "soil/site/site_fixture.h"
#include "soil/site/voxel_file.h"

namespace tera {
namespace {

using ::testing::HasSubstr;

/// 6 x 4 m at 5 cm, 0.2 m above zero at the middle, rising to the east: 0.4 m of dirt over sand.
Columns TopsoilOverSand() {
  return BuildColumns(
      testing_soil::Plan("size_m: [6, 4]\nrelief: {slope_deg: 4}\nlayers:\n"
                         "  - {soil: dirt, from_m: 0, to_m: 0.4, moisture: 0.6}\n"
                         "  - {soil: sand, from_m: 0.4, density_kgpm3: 1650, moisture: 0.1}\n"));
}

double Mass_kg(const SoilVoxels& voxels) {
  return std::accumulate(voxels.mass_kg.begin(), voxels.mass_kg.end(), 0.0);
}

TEST(GroundView, DepthTellsTheStrata) {
  const Columns ground = TopsoilOverSand();
  const auto top = SampleBelow(ground, 1.3, -0.7, 0), deep = SampleBelow(ground, 1.3, -0.7, 0.41);
  ASSERT_TRUE(top && deep);
  EXPECT_EQ(ground.soils()[top->soil].name, "dirt");
  EXPECT_NEAR(top->density_kgpm3, 1474, 1e-6);
  EXPECT_NEAR(top->compaction, 1, 1e-9);
  EXPECT_FLOAT_EQ(top->moisture, 0.6f);
  EXPECT_FALSE(top->loose);
  EXPECT_EQ(ground.soils()[deep->soil].name, "sand");
  EXPECT_NEAR(deep->density_kgpm3, 1650, 1e-6);
  EXPECT_FLOAT_EQ(deep->moisture, 0.1f);
  EXPECT_FALSE(SampleBelow(ground, 1.3, -0.7, -0.01));
  EXPECT_FALSE(SampleBelow(ground, 3.1, 0, 0.1));
}

TEST(GroundView, ATrenchBringsTheLowerLayerToItsFloorAndTheUpperOneToTheHeap) {
  Columns ground = TopsoilOverSand();
  SpoilMix cut;
  for (int i = 40; i < 50; ++i) ground.Cut(ground.Touch(i, 30), ground.TopAt(i, 30) - 0.5, &cut);
  const double x_m = ground.x_m(45), y_m = ground.y_m(30);
  const auto floor = SampleBelow(ground, x_m, y_m, 0);
  ASSERT_TRUE(floor);
  EXPECT_EQ(ground.soils()[floor->soil].name, "sand");
  Spoil dirt = cut.parts()[0];
  ASSERT_EQ(ground.soils()[dirt.soil].name, "dirt");
  ground.DepositAt(80, 60, dirt.Take(0.1));
  const auto heap = SampleBelow(ground, ground.x_m(80), ground.y_m(60), 0.05);
  ASSERT_TRUE(heap);
  EXPECT_TRUE(heap->loose);
  EXPECT_NEAR(heap->compaction, 1 / 1.1, 1e-6);  // dirt swells by a tenth
}

TEST(GroundView, CubesHoldWhatGeometrySays) {
  const Columns ground = TopsoilOverSand();
  // One column, 5 cm wide: surface z0, dirt to z0 - 0.4, sand below.
  const double z0 = ground.TopAt(60, 40);
  const SoilVoxels voxels = CutIntoCubes(ground, {.low_W_m = Vec3(-0.025, -0.025, z0 - 0.49),
                                                  .high_W_m = Vec3(0.025, 0.025, z0 + 0.16)});
  ASSERT_EQ(voxels.nx, 1);
  ASSERT_EQ(voxels.ny, 1);
  ASSERT_EQ(voxels.nz, 13);
  EXPECT_NEAR(voxels.low_W_m.x(), -0.025, 1e-12);
  const double cube_m3 = 0.05 * 0.05 * 0.05;
  EXPECT_NEAR(voxels.mass_kg[0], cube_m3 * 1650, 1e-9);
  // From 0.44 to 0.39 m of depth: 4 cm of sand, 1 cm of dirt.
  EXPECT_NEAR(voxels.mass_kg[1], 0.05 * 0.05 * (0.04 * 1650 + 0.01 * 1474), 1e-9);
  EXPECT_EQ(ground.soils()[voxels.soil[1]].name, "sand");
  EXPECT_EQ(ground.soils()[voxels.soil[2]].name, "dirt");
  EXPECT_FLOAT_EQ(voxels.moisture[2], 0.6f);
  EXPECT_FLOAT_EQ(voxels.fill[2], 1);
  // From 0.04 m below the surface to 0.01 m above it.
  EXPECT_NEAR(voxels.fill[9], 0.8, 1e-6);
  EXPECT_EQ(voxels.mass_kg[10], 0);
  EXPECT_EQ(voxels.soil[10], SoilVoxels::kNoSoil);
}

TEST(GroundView, CubesOfAnySizeHoldAllMass) {
  Columns ground = TopsoilOverSand();
  const double low_m = -1.0, area_m2 = ground.area_m2();
  double start_kg = 0;
  for (int j = 0; j < ground.ny(); ++j) {
    for (int i = 0; i < ground.nx(); ++i) {
      const double depth_m = ground.TopAt(i, j) - low_m;
      start_kg += area_m2 * (0.4 * 1474 + (depth_m - 0.4) * 1650);
    }
  }
  SpoilMix cut, beside;
  for (int j = 20; j < 40; ++j) {
    for (int i = 40; i < 60; ++i) ground.Cut(ground.Touch(i, j), -0.3 + 0.001 * i, &cut);
  }
  for (int i = 70; i < 90; ++i) ground.DepositAt(i, 50, cut.Take(0.005));
  for (int i = 10; i < 20; ++i) ground.Press(ground.Touch(i, 10), {0.04, 0.3}, &beside);
  for (const int columns : {1, 3, 8}) {
    const SoilVoxels voxels = CutIntoCubes(ground, {.low_W_m = Vec3(-3.025, -2.025, low_m),
                                                    .high_W_m = Vec3(3.025, 2.025, 2.0),
                                                    .columns = columns});
    EXPECT_NEAR(Mass_kg(voxels), start_kg + ground.GroundGain().net_kg, 1e-9 * start_kg) << columns;
  }
}

TEST(GroundView, CompactionShowsUnderAPressedPlateAlone) {
  Columns ground = TopsoilOverSand();
  SpoilMix beside;
  ground.Press(ground.Touch(60, 40), {0.06, 0.3}, &beside);
  ASSERT_TRUE(beside.empty());
  const auto pressed = SampleBelow(ground, 0, 0, 0.1), below = SampleBelow(ground, 0, 0, 0.25);
  const auto next_to_it = SampleBelow(ground, 0.05, 0, 0.1);
  ASSERT_TRUE(pressed && below && next_to_it);
  EXPECT_NEAR(pressed->compaction, 0.30 / 0.24, 1e-6);
  EXPECT_NEAR(below->compaction, 1, 1e-9);
  EXPECT_NEAR(next_to_it->compaction, 1, 1e-9);
}

/// The part of a text between two marks.
std::string Between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t begin = text.find(before) + before.size();
  return text.substr(begin, text.find(after, begin) - begin);
}

class VoxelFileTest : public testing_soil::FolderTest {};

TEST_F(VoxelFileTest, SaysWhereItsCubesAreAndWhatTheyHold) {
  const Columns ground = TopsoilOverSand();
  const SoilVoxels voxels = CutIntoCubes(
      ground, {.low_W_m = Vec3(-1, -0.5, -0.6), .high_W_m = Vec3(1, 0.7, 0.4), .columns = 2});
  WriteVoxels(File("box.vti"), voxels, ground.soils());
  std::ifstream in(File("box.vti"), std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  EXPECT_THAT(text, HasSubstr("WholeExtent=\"0 20 0 12 0 10\""));
  EXPECT_THAT(text, HasSubstr("Spacing=\"0.1 0.1 0.1\""));
  EXPECT_THAT(text, HasSubstr("NumberOfTuples=\"2\" format=\"ascii\">100 105 114 116 0 115 97"));
  std::istringstream origin(Between(text, "Origin=\"", "\""));
  double x, y, z;
  origin >> x >> y >> z;
  EXPECT_NEAR(x, voxels.low_W_m.x(), 1e-12);
  EXPECT_NEAR(y, voxels.low_W_m.y(), 1e-12);
  EXPECT_NEAR(z, -0.6, 1e-12);
  // The appended data: each array is its size in bytes and its numbers.
  const std::size_t data = text.find("<AppendedData encoding=\"raw\">\n_") + 31;
  const std::size_t offset =
      std::stoul(Between(text, "Name=\"mass_kg\" format=\"appended\" offset=\"", "\""));
  std::uint64_t size;
  std::memcpy(&size, &text[data + offset], sizeof(size));
  EXPECT_EQ(size, 20u * 12 * 10 * sizeof(float));
  double sum_kg = 0;
  for (std::size_t n = 0; n < voxels.size(); ++n) {
    float mass_kg;
    std::memcpy(&mass_kg, &text[data + offset + sizeof(size) + n * sizeof(float)], sizeof(float));
    sum_kg += mass_kg;
  }
  EXPECT_NEAR(sum_kg, Mass_kg(voxels), 1e-5 * sum_kg);
}

TEST_F(VoxelFileTest, AFolderThatIsNotThereIsAnError) {
  const Columns ground = TopsoilOverSand();
  const SoilVoxels voxels =
      CutIntoCubes(ground, {.low_W_m = Vec3(-1, -1, -1), .high_W_m = Vec3(0, 0, 0)});
  EXPECT_THROW(WriteVoxels(File("no/such.vti"), voxels, ground.soils()), InputError);
}

}  // namespace
}  // namespace tera
