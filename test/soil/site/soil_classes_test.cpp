#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "core/faults.h"
#include "soil/site/geotiff_fixture.h"
#include "soil/site/site_fixture.h"

// A raster that says which soil lies where (soil_classes).

namespace tera {
namespace {

using enum FaultKind;
using namespace testing_soil;

class SoilClassesTest : public FolderTest {};

/// Twelve by eight pixels of half a metre: class 1 west, 2 east, 7 in the north-east corner pixel.
void WriteClasses(const std::string& file, GDALDataType type = GDT_Byte, bool referenced = true) {
  std::vector<std::vector<double>> rows(8, std::vector<double>(12, 1));
  for (auto& row : rows) std::fill(row.begin() + 6, row.end(), 2);
  rows[0][11] = 7;
  WriteUtmRaster(file, rows, 0.5, {500000, 5200000}, type, referenced);
}

std::string ClassesYaml(const std::string& file, const std::string& classes) {
  return "soil_classes: {geotiff: " + file + ", classes: [" + classes + "]}\n";
}

TEST_F(SoilClassesTest, SayWhatLiesWhere) {
  WriteClasses(File("soil.tif"));
  const std::string classes =
      "{value: 1, soil: sand}, {value: 2, layers: [{soil: dirt, from_m: 0, to_m: 0.2}, "
      "{soil: gravel, from_m: 0.2}]}, {value: 7, soil: asphalt}";
  const SitePlan plan = Plan(ClassesYaml(File("soil.tif"), classes) + "cell_m: 0.05\n");
  // The file's middle is W's origin. UTM's scale on the central meridian is 0.9996.
  ASSERT_TRUE(plan.georeference);
  EXPECT_NEAR(plan.georeference->lon_deg, 15, 1e-4);
  EXPECT_NEAR(plan.ground.grid.cell_m * (plan.ground.grid.nx - 1), 11 * 0.5 / 0.9996, 0.05);
  EXPECT_EQ(SoilAt(plan, -0.05, 0, 0), "sand");
  EXPECT_EQ(SoilAt(plan, 0.05, 0, 0), "dirt");
  EXPECT_EQ(SoilAt(plan, 0.05, 0, 0.21), "gravel");
  EXPECT_EQ(SoilAt(plan, 2.6, 1.6, 0), "asphalt");
  EXPECT_EQ(SoilAt(plan, 2.4, 1.6, 0), "dirt");
  EXPECT_EQ(SoilAt(plan, 2.6, 1.4, 0), "dirt");
}

TEST_F(SoilClassesTest, LieWhereTheHeightsLie) {
  // The heights' file reaches 4 m further west than the classes', so that its middle, W's origin,
  // lies 2 m west of theirs.
  WriteClasses(File("soil.tif"));
  WriteUtmRaster(File("height.tif"), std::vector(8, std::vector<double>(20, 120.0)), 0.5,
                 {499996, 5200000}, GDT_Float32);
  const SitePlan plan =
      Plan("geotiff: " + File("height.tif") + "\nsize_m: [1, 3]\ncell_m: 0.05\n" +
           ClassesYaml(File("soil.tif"),
                       "{value: 1, soil: sand}, {value: 2, soil: dirt}, {value: 7, soil: gravel}"));
  EXPECT_NEAR(plan.georeference->height_m, 120, 1e-6);
  EXPECT_EQ(SoilAt(plan, 1.95, 0, 0), "sand");
  EXPECT_EQ(SoilAt(plan, 2.05, 0, 0), "dirt");
}

TEST_F(SoilClassesTest, AreScaledAsTheirBandSays) {
  WriteUtmRaster(File("soil.tif"), std::vector(8, std::vector<double>(12, 20)), 0.5);
  EditBand(File("soil.tif"), [](GDALRasterBand* band) {
    band->SetScale(0.1);
    band->SetOffset(1);
  });
  EXPECT_EQ(SoilAt(Plan(ClassesYaml(File("soil.tif"), "{value: 3, soil: gravel}")), 0, 0, 0),
            "gravel");
  EditBand(File("soil.tif"), [](GDALRasterBand* band) { band->SetScale(0.13); });
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), "{value: 3, soil: gravel}")),
              HasFault(kMistyped, "soil_classes.geotiff"));
}

TEST_F(SoilClassesTest, OnlyTilesWithABorderAreSeenVertexByVertex) {
  std::vector<std::vector<double>> rows(20, std::vector<double>(40, 1));
  for (auto& row : rows) std::fill(row.begin() + 13, row.end(), 2);  // the border: x = -7 m
  WriteUtmRaster(File("soil.tif"), rows, 1.0);
  const auto soil =
      MakeGround(ClassesYaml(File("soil.tif"), "{value: 1, soil: sand}, {value: 2, soil: dirt}"));
  const TerrainSurface& ground = soil->surface();
  int refined = 0;
  double sand_m2 = 0;
  for (int b = 0; b < ground.tiles_y(); ++b) {
    for (int a = 0; a < ground.tiles_x(); ++a) refined += ground.IsRefined(a, b);
  }
  EXPECT_LE(refined, 3 * ground.tiles_y());  // of 16 along x
  for (int j = 0; j < ground.ny; ++j) {
    for (int i = 0; i < ground.nx; ++i) {
      sand_m2 += soil->soils()[ground.at(i, j).cover.soil].name == "sand" ? 0.05 * 0.05 : 0;
    }
  }
  EXPECT_NEAR(sand_m2, 12.5 * 19.05, 1.5);
}

TEST_F(SoilClassesTest, EveryFaultIsNamed) {
  WriteClasses(File("soil.tif"));
  const std::string two = "{value: 1, soil: sand}, {value: 2, soil: dirt}";
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), two)),
              HasFault(kInconsistent, "soil_classes.geotiff"));
  const std::string all = two + ", {value: 7, soil: gravel}";
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), all)), testing::IsEmpty());
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), all) + "soil: dirt\n"),
              HasFault(kInconsistent, "soil"));
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), all + ", {value: 2, soil: sand}")),
              HasFault(kRepeated, "value"));
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), "")), HasFault(kNoSuchName, "classes"));
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), "{value: 300, soil: sand}")),
              HasFault(kOutOfRange));
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), all) + "size_m: [40, 4]\n"),
              HasFault(kInconsistent, "soil_classes.geotiff"));
  WriteClasses(File("float.tif"), GDT_Float32);
  EXPECT_THAT(FaultsOf(ClassesYaml(File("float.tif"), all)), HasFault(kUnsupported, "float.tif"));
  WriteClasses(File("nowhere.tif"), GDT_Byte, false);
  EXPECT_THAT(FaultsOf(ClassesYaml(File("nowhere.tif"), all)), HasFault(kMissing, "nowhere.tif"));
  {
    std::unique_ptr<GDALDataset, ReadRaster::Close> file(
        static_cast<GDALDataset*>(GDALOpen(File("soil.tif").c_str(), GA_Update)));
    file->GetRasterBand(1)->SetNoDataValue(7);
  }
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), two)),
              HasFault(kInconsistent, "soil_classes.geotiff"));
}

TEST_F(SoilClassesTest, WhatWasExportedComesBack) {
  const auto soil = MakeGround(
      "size_m: [8, 6]\ncell_m: 0.1\nsoils: [dirt, sand]\n"
      "regions:\n  - {outline_m: [[-2, -1], [2, -1], [0, 2]], soil: sand}\n");
  soil->WriteGeoTiff(File("soil.tif"), GroundRaster::kSoilClass, {46.8, -71.2, 80}, 1);
  const auto again =
      MakeGround("cell_m: 0.1\n" +
                 ClassesYaml(File("soil.tif"), "{value: 0, soil: dirt}, {value: 1, soil: sand}"));
  const TerrainSurface &a = soil->surface(), &b = again->surface();
  ASSERT_EQ(a.nx, b.nx);
  ASSERT_EQ(a.ny, b.ny);
  for (int j = 0; j < a.ny; ++j) {
    for (int i = 0; i < a.nx; ++i) ASSERT_EQ(a.at(i, j).cover.soil, b.at(i, j).cover.soil);
  }
}

}  // namespace
}  // namespace tera
