#include "soil/site/ground_raster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

#include "core/error.h"
#include "geotiff_fixture.h"
#include "site_fixture.h"

namespace tera {
namespace {

using testing_soil::FolderTest;
using testing_soil::ReadRaster;

class GroundRasterTest : public FolderTest {};

constexpr SiteOrigin kQuebec{46.81, -71.21, 87.5};
constexpr double kSand_kgpm3 = 1500, kGravel_kgpm3 = 1550;

/// 12 x 8 m at 10 cm, sloping: 0.3 m of sand over gravel, one soil more that is named alone.
Columns Layered() {
  return BuildColumns(testing_soil::Plan(
      "size_m: [12, 8]\ncell_m: 0.1\nsoils: [dirt]\nrelief: {slope_deg: 5}\nlayers:\n"
      "  - {soil: sand, from_m: 0, to_m: 0.3, density_kgpm3: 1500}\n"
      "  - {soil: gravel, from_m: 0.3, density_kgpm3: 1550}\n"));
}

/// Takes 0.5 m off the columns of x 1.0 to 2.9 m, y -2.0 to -1.1 m.
SpoilMix CutTrench(Columns* ground) {
  SpoilMix cut;
  for (int j = 20; j < 30; ++j) {
    for (int i = 70; i < 90; ++i) ground->Cut(ground->Touch(i, j), ground->TopAt(i, j) - 0.5, &cut);
  }
  return cut;
}
constexpr double kTrench_m2 = 2.0 * 1.0;

TEST_F(GroundRasterTest, ATrenchIsADropOfItsDepth) {
  Columns ground = Layered();
  CutTrench(&ground);
  WriteGroundRaster(File("change.tif"), ground, GroundRaster::kChange, kQuebec, 1);
  const ReadRaster change(File("change.tif"));
  EXPECT_EQ(change.nx, 121);
  EXPECT_EQ(change.ny, 81);
  EXPECT_NEAR(change.At(1.0, -2.0), -0.5, 1e-6);
  EXPECT_NEAR(change.At(2.9, -1.1), -0.5, 1e-6);
  EXPECT_EQ(change.At(0.9, -2.0), 0);
  EXPECT_EQ(change.At(2.9, -1.0), 0);
  EXPECT_NEAR(change.Sum() * change.pixel_m2(), -0.5 * kTrench_m2, 1e-6);
  EXPECT_STREQ(change.band()->GetUnitType(), "m");
}

TEST_F(GroundRasterTest, ATrenchShowsTheSoilBelow) {
  Columns ground = Layered();
  CutTrench(&ground);
  WriteGroundRaster(File("class.tif"), ground, GroundRaster::kSoilClass, kQuebec, 1);
  WriteGroundRaster(File("density.tif"), ground, GroundRaster::kDensity, kQuebec, 1);
  const ReadRaster soil(File("class.tif")), density(File("density.tif"));
  EXPECT_EQ(soil.band()->GetRasterDataType(), GDT_Byte);
  EXPECT_STREQ(soil.dataset->GetMetadataItem("SOIL_0"), "dirt");
  EXPECT_STREQ(soil.dataset->GetMetadataItem("SOIL_1"), "sand");
  EXPECT_STREQ(soil.dataset->GetMetadataItem("SOIL_2"), "gravel");
  EXPECT_EQ(soil.At(2, -1.5), 2);
  EXPECT_EQ(soil.At(2, 1.5), 1);
  EXPECT_EQ(soil.At(-5.5, 3.5), 1);  // in a quiet tile
  EXPECT_NEAR(soil.Sum() * soil.pixel_m2(), 12.1 * 8.1 * 1 + kTrench_m2 * 1, 1e-6);
  EXPECT_NEAR(density.At(2, -1.5), kGravel_kgpm3, 1e-3);
  EXPECT_NEAR(density.At(2, 1.5), kSand_kgpm3, 1e-3);
  EXPECT_NEAR(density.At(-5.5, 3.5), kSand_kgpm3, 1e-3);
}

TEST_F(GroundRasterTest, ChangeTimesDensityIsTheMassOfTheLedger) {
  Columns ground = Layered();
  const SpoilMix cut = CutTrench(&ground);
  // By hand: the trench's strata.
  const double cut_kg = kTrench_m2 * (0.3 * kSand_kgpm3 + 0.2 * kGravel_kgpm3);
  EXPECT_NEAR(cut.mass_kg(), cut_kg, 1e-9 * cut_kg);
  // A tenth of it goes onto one square metre as loose sand.
  SpoilMix rest = cut;
  const Spoil sand = rest.parts()[0];
  EXPECT_EQ(sand.soil, 1);
  for (int j = 50; j < 60; ++j) {
    for (int i = 20; i < 30; ++i) {
      ground.DepositAt(i, j, Spoil{sand.mass_kg / 100, sand.volume_m3 / 100, 1, sand.moisture});
    }
  }
  for (const GroundRaster raster :
       {GroundRaster::kChange, GroundRaster::kDensity, GroundRaster::kMassChange}) {
    WriteGroundRaster(File(std::string(NameOf(raster))), ground, raster, kQuebec, 1);
  }
  const ReadRaster change(File("change")), density(File("density")), mass(File("mass_change"));
  double heap_kg = 0;
  for (std::size_t k = 0; k < change.value.size(); ++k) {
    if (change.value[k] > 0) heap_kg += change.value[k] * density.value[k] * change.pixel_m2();
  }
  EXPECT_NEAR(heap_kg, sand.mass_kg, 1e-5 * cut_kg);
  EXPECT_NEAR(mass.Sum() * mass.pixel_m2(), sand.mass_kg - cut_kg, 1e-6 * cut_kg);
  EXPECT_NEAR(mass.Sum() * mass.pixel_m2(), ground.GroundGain().net_kg, 1e-6 * cut_kg);
  EXPECT_STREQ(mass.band()->GetUnitType(), "kg/m^2");
}

TEST_F(GroundRasterTest, AGisFindsTheTrenchWhereGeodesySaysItIs) {
  Columns ground = Layered();
  CutTrench(&ground);
  WriteGroundRaster(File("change.tif"), ground, GroundRaster::kChange, kQuebec, 1);
  WriteGroundRaster(File("height.tif"), ground, GroundRaster::kHeight, kQuebec, 1);
  const ReadRaster change(File("change.tif")), height(File("height.tif"));
  const OGRSpatialReference* projection = change.dataset->GetSpatialRef();
  ASSERT_NE(projection, nullptr);
  EXPECT_TRUE(projection->IsProjected());
  EXPECT_EQ(projection->GetLinearUnits(), 1.0);
  OGRSpatialReference wgs84;
  wgs84.SetWellKnownGeogCS("WGS84");
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  std::unique_ptr<OGRCoordinateTransformation> to_file(
      OGRCreateCoordinateTransformation(&wgs84, projection));
  const GeographicLib::LocalCartesian plane(kQuebec.lat_deg, kQuebec.lon_deg, kQuebec.height_m);
  for (const auto& [x, y, depth_m] : {std::tuple{1.02, -1.97, 0.5},
                                      {2.88, -1.13, 0.5},
                                      {0.88, -1.97, 0.0},
                                      {2.88, -0.97, 0.0},
                                      {-5.7, 3.2, 0.0}}) {
    const double slope_m = std::tan(5 * kDeg) * x;
    double lat, lon, above_m;
    plane.Reverse(x, y, slope_m - depth_m, lat, lon, above_m);
    ASSERT_TRUE(to_file->Transform(1, &lon, &lat));
    EXPECT_NEAR(change.At(lon, lat), -depth_m, 1e-6) << x << ' ' << y;
    // The pixel's middle may lie 5 cm off along the slope.
    EXPECT_NEAR(height.At(lon, lat), above_m, 0.05 * std::tan(5 * kDeg) + 1e-3) << x << ' ' << y;
  }
}

TEST_F(GroundRasterTest, CoarsePixelsAreMeansAndLoseNothing) {
  Columns ground = Layered();
  CutTrench(&ground);
  for (const GroundRaster raster : {GroundRaster::kChange, GroundRaster::kSoilClass}) {
    WriteGroundRaster(File(std::string(NameOf(raster))), ground, raster, kQuebec, 4);
  }
  const ReadRaster change(File("change")), soil(File("soil_class"));
  EXPECT_EQ(change.nx, 31);  // 121 columns: the last pixel has one
  EXPECT_EQ(change.ny, 21);
  EXPECT_NEAR(change.affine[0], -6.05, 1e-12);
  EXPECT_NEAR(change.affine[3], -4.05 + 21 * 0.4, 1e-12);
  EXPECT_NEAR(change.affine[1], 0.4, 1e-12);
  EXPECT_NEAR(change.Sum() * change.pixel_m2(), -0.5 * kTrench_m2, 1e-6);
  // Columns 68 to 71 along x: two of four in the trench. 72 to 75: all.
  EXPECT_NEAR(change.At(0.9, -1.8), -0.25, 1e-6);
  EXPECT_NEAR(change.At(1.4, -1.8), -0.5, 1e-6);
  EXPECT_EQ(soil.At(1.4, -1.8), 2);
  EXPECT_EQ(soil.At(3.4, -1.8), 1);
}

TEST_F(GroundRasterTest, ChangeCountsFromTheMarkedStart) {
  const auto soil = testing_soil::MakeGround(
      "size_m: [6, 6]\ncell_m: 0.1\nsoil: sand\npiles: [{xy_m: [1, 1], height_m: 0.6, soil: "
      "sand}]\n");
  const int bucket = [&] {
    GroundTools tools;
    tools.shovels = {testing_soil::CompactBucket()};
    return soil->AddMachine(tools);
  }();
  const auto sum = [&](const char* name) {
    soil->WriteGeoTiff(File(name), GroundRaster::kMassChange, kQuebec, 1);
    const ReadRaster mass(File(name));
    return mass.Sum() * mass.pixel_m2();
  };
  EXPECT_NEAR(sum("pile.tif"), 0, 1e-9);  // it was there when the site was read
  // Half a dig: the bucket is full, in the air.
  testing_soil::RunBucket(soil.get(), bucket, testing_soil::DigCycle(0.25),
                          [&](double t_s, const BodyState&, const SoilReaction& reaction) {
                            if (std::abs(t_s - 5.0) > 0.5 * testing_soil::kStep_s) return;
                            const MassLedger ledger = soil->ledger();
                            EXPECT_GT(reaction.shovel_load[0].mass_kg, 50);
                            EXPECT_NEAR(sum("dug.tif"), ledger.ground_kg, 1e-3);
                            soil->MarkStart();
                            EXPECT_NEAR(sum("marked.tif"), 0, 1e-9);
                          });
  // The bucket's load at that time has come down since.
  const double after_kg = sum("dumped.tif");
  EXPECT_GT(after_kg, 50);
}

TEST_F(GroundRasterTest, ALargeSiteIsWrittenWhileItsQuietTilesStayWithoutColumns) {
  Columns ground = BuildColumns(testing_soil::Plan("size_m: [500, 500]\nsoil: dirt\n"));
  SpoilMix cut;
  ground.Cut(ground.Touch(9000, 40), ground.TopAt(9000, 40) - 1.0, &cut);
  WriteGroundRaster(File("change.tif"), ground, GroundRaster::kChange, kQuebec, 20);
  const ReadRaster change(File("change.tif"));
  EXPECT_EQ(change.nx, 501);
  EXPECT_NEAR(change.At(9000 * 0.05 - 250, 40 * 0.05 - 250), -1.0 / 400, 1e-8);
  EXPECT_NEAR(change.Sum(), -1.0 / 400, 1e-8);
  int with_columns = 0;
  for (int b = 0; b < ground.grid().tiles_y(); ++b) {
    for (int a = 0; a < ground.grid().tiles_x(); ++a) with_columns += ground.HasColumns(a, b);
  }
  EXPECT_EQ(with_columns, 1);
}

TEST_F(GroundRasterTest, ManyPixelsHaveOverviewsForAGis) {
  const Columns ground =
      BuildColumns(testing_soil::Plan("size_m: [210, 4]\ncell_m: 0.1\nsoil: dirt\n"));
  WriteGroundRaster(File("density.tif"), ground, GroundRaster::kDensity, kQuebec, 1);
  const ReadRaster density(File("density.tif"));
  EXPECT_EQ(density.nx, 2101);
  EXPECT_EQ(density.band()->GetOverviewCount(), 2);
  EXPECT_NEAR(density.value.back(), 1474, 1e-3);
}

}  // namespace
}  // namespace tera
