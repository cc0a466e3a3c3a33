#include "soil/site.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "geotiff_fixture.h"
#include "soil/geotiff.h"
#include "soil_fixture.h"

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing_soil::MakeSite;

/// What is wrong with a terrain mapping, or nothing.
std::string FaultsOf(const std::string& yaml) {
  try {
    MakeSite(yaml);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

SitePlan Plan(const std::string& yaml, std::uint64_t seed = 1) {
  const Config config = Config::FromText(yaml, "site.yaml");
  SitePlan plan = ReadSite(config.root(), seed);
  config.Finish();
  return plan;
}

TEST(Site, DefaultsAreFortyMetresOfDirtCentredOnTheOrigin) {
  const auto soil = MakeSite("{}");
  const TerrainSurface& ground = soil->surface();
  EXPECT_EQ(ground.nx, 801);
  EXPECT_EQ(ground.ny, 801);
  EXPECT_EQ(ground.origin_W_m, Vec2(-20, -20));
  ASSERT_EQ(soil->soils().size(), 1u);
  EXPECT_EQ(soil->soils()[0].name, "dirt");
  EXPECT_FALSE(soil->georeference());
}

TEST(Site, SizeAndCellSetTheGrid) {
  const SitePlan plan = Plan("size_m: [12, 6]\ncell_m: 0.1\n");
  EXPECT_EQ(plan.ground.grid.nx, 121);
  EXPECT_EQ(plan.ground.grid.ny, 61);
  EXPECT_EQ(plan.ground.grid.cell_m, 0.1);
}

TEST(Site, EveryShippedSoilIsReadable) {
  for (const char* name :
       {"dirt", "gravel", "sand", "loose_sand", "wet_sand", "loose", "clay", "asphalt"}) {
    const SitePlan plan = Plan(std::string("size_m: [2, 2]\nsoil: ") + name + "\n");
    EXPECT_EQ(plan.soils[0].name, name);
  }
}

TEST(Site, StrengthUnderRunningGearIsItsOwnOrThatOfTheGround) {
  const SoilType sand = Plan("size_m: [2, 2]\nsoil: sand\n").soils[0];
  EXPECT_NEAR(sand.friction_angle_rad, 39 * kDeg, 1e-12);
  EXPECT_NEAR(sand.shear_friction_rad, 28 * kDeg, 1e-12);
  EXPECT_EQ(sand.cohesion_pa, 0);
  EXPECT_EQ(sand.shear_cohesion_pa, 1040);
  const SoilType clay = Plan("size_m: [2, 2]\nsoil: clay\n").soils[0];
  EXPECT_NEAR(clay.shear_friction_rad, 13 * kDeg, 1e-12);
  EXPECT_EQ(clay.shear_cohesion_pa, 4140);
}

TEST(Site, StripsSetTheSoilAlongTheirAxis) {
  const auto soil = MakeSite(
      "size_m: [12, 4]\nsoils: [dirt, gravel, sand]\n"
      "strips:\n"
      "  - {soil: gravel, axis: x, from_m: -2, to_m: 2}\n"
      "  - {soil: sand, axis: y, from_m: 1, to_m: 3}\n");
  const TerrainSurface& ground = soil->surface();
  const auto at = [&](double x, double y) {
    return soil
        ->soils()[ground
                      .at(static_cast<int>(std::lround((x + 6) / 0.05)),
                          static_cast<int>(std::lround((y + 2) / 0.05)))
                      .cover.soil]
        .name;
  };
  EXPECT_EQ(at(-4, 0), "dirt");
  EXPECT_EQ(at(0, 0), "gravel");
  EXPECT_EQ(at(4, 0), "dirt");
  EXPECT_EQ(at(4, 1.5), "sand");
}

TEST(Site, RegionsAndLayersSetWhatLiesWhere) {
  const SitePlan plan = Plan(
      "size_m: [12, 6]\nlayers:\n"
      "  - {soil: dirt, from_m: 0, to_m: 0.3, moisture: 0.7}\n"
      "  - {soil: gravel, from_m: 0.3, density_kgpm3: 1590}\n"
      "regions:\n"
      "  - {outline_m: [[-2, -1], [2, -1], [0, 2]], soil: sand}\n");
  const auto soil_at = [&](double x, double y, double depth_m) {
    const GroundProfile& profile = plan.ground.profiles[plan.ground.ProfileAt(Vec2(x, y))];
    return plan.soils[profile.Below(depth_m).soil].name;
  };
  EXPECT_EQ(soil_at(-5, 0, 0), "dirt");
  EXPECT_EQ(soil_at(-5, 0, 0.31), "gravel");
  EXPECT_EQ(soil_at(0, 0, 0), "sand");
  EXPECT_EQ(soil_at(0, 0, 4), "sand");
  EXPECT_EQ(soil_at(1.5, 1.5, 0), "dirt");  // in the triangle's box, outside its sides
  const GroundProfile& layers = plan.ground.profiles[0];
  EXPECT_NEAR(layers.Mass_kgpm2(0.1, 0.5), 0.2 * 1474 + 0.2 * 1590, 1e-9);
  EXPECT_FLOAT_EQ(layers.Below(0).moisture, 0.7f);
}

TEST(Site, ARegionIsSeenWithItsExactOutline) {
  const auto soil = MakeSite(
      "size_m: [12, 6]\nsoils: [dirt, sand]\n"
      "regions:\n  - {outline_m: [[-2, -1], [2, -1], [0, 2]], soil: sand}\n");
  const TerrainSurface& ground = soil->surface();
  double sand_m2 = 0;
  for (int j = 0; j < ground.ny; ++j) {
    for (int i = 0; i < ground.nx; ++i) {
      if (soil->soils()[ground.at(i, j).cover.soil].name == "sand") sand_m2 += 0.05 * 0.05;
    }
  }
  EXPECT_NEAR(sand_m2, 6.0, 0.1);  // 4 m x 3 m / 2
}

TEST(Site, AQuietSiteIsKnownByFewHeights) {
  const SitePlan plan = Plan("size_m: [500, 500]\nrelief: {amplitude_m: 0.3, wavelength_m: 8}\n");
  EXPECT_EQ(plan.ground.grid.nx, 10001);
  EXPECT_LE(plan.ground.base_height_m.size(), 1100u * 1100u);  // of 10^8 columns
}

TEST(Site, SlopeRisesTowardsItsAzimuth) {
  const SitePlan plan =
      Plan("size_m: [10, 10]\nrelief: {slope_deg: 10, slope_direction_deg: 90}\n");
  const auto height = [&](int i, int j) { return plan.ground.HeightAt(i, j); };
  EXPECT_NEAR(height(50, 200) - height(50, 0), 10 * std::tan(10 * kDeg), 1e-9);
  EXPECT_NEAR(height(150, 60), height(10, 60), 1e-9);
}

TEST(Site, ReliefIsSeededAndKeepsToItsAmplitudeAndWavelength) {
  const std::string yaml = "size_m: [20, 20]\nrelief: {amplitude_m: 0.3, wavelength_m: 5}\n";
  const SitePlan plan = Plan(yaml), again = Plan(yaml), other = Plan(yaml, 2);
  EXPECT_EQ(plan.ground.base_height_m, again.ground.base_height_m);
  EXPECT_NE(plan.ground.base_height_m, other.ground.base_height_m);
  const std::vector<double>& heights = plan.ground.base_height_m;
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  EXPECT_GT(*high - *low, 0.1);
  EXPECT_LE(*high, 0.3);
  EXPECT_GE(*low, -0.3);
  // Five times the wavelength: gentler slopes.
  const SitePlan longer = Plan("size_m: [20, 20]\nrelief: {amplitude_m: 0.3, wavelength_m: 25}\n");
  const auto steepest = [](const SitePlan& p) {
    double s = 0;
    for (int j = 0; j < p.ground.grid.ny; ++j) {
      for (int i = 1; i < p.ground.grid.nx; ++i) {
        s = std::max(s, std::abs(p.ground.HeightAt(i, j) - p.ground.HeightAt(i - 1, j)));
      }
    }
    return s;
  };
  EXPECT_GT(steepest(plan), 3 * steepest(longer));
}

TEST(Site, PileIsAConeOfLooseSoilAtItsReposeAngleAndStaysSo) {
  const auto soil = MakeSite(
      "size_m: [10, 10]\nsoil: dirt\npiles: [{xy_m: [1, -2], height_m: 1.0, soil: gravel}]\n");
  const TerrainSurface& ground = soil->surface();
  EXPECT_NEAR(ground.HeightAt(1, -2), 1.0, 1e-6);
  EXPECT_NEAR(ground.HeightAt(1 + 0.8, -2), 1.0 - 0.8 * std::tan(32 * kDeg), 1e-3);
  EXPECT_EQ(soil->soils()[ground.at(120, 60).cover.soil].name, "gravel");
  for (int k = 0; k < 500; ++k) soil->Flow(0.002);
  EXPECT_NEAR(ground.HeightAt(1, -2), 1.0, 0.03);
}

TEST(Site, EveryFaultOfATerrainIsNamed) {
  EXPECT_THAT(FaultsOf("soil: drt\n"),
              AllOf(HasSubstr("site.yaml:1:7: soil: no soil named 'drt'"),
                    HasSubstr("asphalt, clay, dirt, gravel, loose, loose_sand, sand, wet_sand")));
  EXPECT_THAT(FaultsOf("sise_m: [1, 1]\n"), HasSubstr("did you mean 'size_m'"));
  EXPECT_THAT(FaultsOf("cell_m: 0\n"), HasSubstr("out of range"));
  EXPECT_THAT(FaultsOf("size_m: [2000, 2000]\ncell_m: 0.01\n"), HasSubstr("use a larger cell_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nstrips: [{soil: sand, from_m: 2, to_m: 1}]\n"),
              HasSubstr("1 is not beyond from_m 2"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nstrips:\n  - {soil: sand, from_m: 0, to_m: 2}\n"
                       "  - {soil: dirt, from_m: 1, to_m: 3}\n"),
              HasSubstr("overlaps the one from 0 to 2 m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\npiles: [{xy_m: [0, 0], height_m: -1, soil: sand}]\n"),
              HasSubstr("piles[0].height_m: -1 is out of range"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\npiles: [{xy_m: [0, 2.1], height_m: 1, soil: sand}]\n"),
              HasSubstr("piles[0].xy_m: lies beyond the site, x -2 to 2 m, y -2 to 2 m"));
  EXPECT_THAT(
      FaultsOf("size_m: [4, 4]\nlayers:\n  - {soil: dirt, from_m: 0, to_m: 0.4}\n"
               "  - {soil: sand, from_m: 0.3}\n"),
      HasSubstr("layers[1].from_m: this layer overlaps the one above it, which ends at 0.4"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nlayers:\n  - {soil: dirt, from_m: 0, to_m: 0.4}\n"
                       "  - {soil: sand, from_m: 0.5}\n"),
              HasSubstr("no layer from 0.4 to 0.5 m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nsoil: dirt\nlayers: [{soil: dirt, from_m: 0}]\n"),
              HasSubstr("soil and layers exclude each other"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nlayers: [{soil: dirt, from_m: 0, to_m: 1}]\n"),
              HasSubstr("the lowest layer goes on without end"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nregions:\n"
                       "  - {outline_m: [[0, 0], [1, 1], [1, 0], [0, 1]], soil: sand}\n"),
              HasSubstr("its sides 1 and 3 cross"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nregions:\n"
                       "  - {outline_m: [[0, 0], [1, 1], [2, 2]], soil: sand}\n"),
              HasSubstr("enclose no area"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nregions:\n"
                       "  - {outline_m: [[0, 0], [1, 1]], soil: sand}\n"),
              HasSubstr("outline_m: 2 corners found, need at least 3"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nlayers: [{soil: dirt, from_m: 0, density_kgpm3: 2500}]\n"),
              HasSubstr("2500 is not a density of dirt, need 1340 (dug) to 2000 (compacted)"));
  const std::string dirt =
      "size_m: [4, 4]\nsoil: mine\ncustom_soils:\n  - {preset: "
      "tera:config/soils/dirt.yaml, name: mine, ";
  EXPECT_EQ(FaultsOf(dirt + "cohesion_pa: 10}\n"), "");
  EXPECT_THAT(FaultsOf(dirt + "bank_density_kgpm3: -5}\n"), HasSubstr("-5 is out of range"));
  EXPECT_THAT(FaultsOf(dirt + "friction_angle_deg: 90}\n"), HasSubstr("90 is out of range"));
  EXPECT_THAT(FaultsOf(dirt + "shear_friction_deg: 90}\n"), HasSubstr("90 is out of range"));
  EXPECT_THAT(FaultsOf(dirt + "shear_cohesion_pa: -1}\n"), HasSubstr("-1 is out of range"));
  EXPECT_THAT(FaultsOf(dirt + "max_density_kgpm3: 1000}\n"),
              HasSubstr("1000 is less than bank_density_kgpm3 1474"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\ncustom_soils:\n"
                       "  - {preset: tera:config/soils/dirt.yaml}\n"
                       "  - {preset: tera:config/soils/dirt.yaml}\n"),
              HasSubstr("second soil named 'dirt'"));
}

class GeotiffTest : public testing_soil::FolderTest {};

TEST_F(GeotiffTest, HeightsAndPlaceSurviveARoundTrip) {
  const auto soil =
      MakeSite("size_m: [12, 8]\ncell_m: 0.1\nrelief: {amplitude_m: 0.5, wavelength_m: 4}\n");
  const SiteOrigin origin{46.81, -71.21, 87.5};
  soil->WriteGeoTiff(File("site.tif"), GroundRaster::kHeight, origin, 1);
  const auto again = MakeSite("cell_m: 0.1\ngeotiff: " + File("site.tif") + "\n");
  ASSERT_TRUE(again->georeference());
  EXPECT_NEAR(again->georeference()->lat_deg, origin.lat_deg, 1e-9);
  EXPECT_NEAR(again->georeference()->lon_deg, origin.lon_deg, 1e-9);
  const TerrainSurface &a = soil->surface(), &b = again->surface();
  ASSERT_EQ(b.nx, a.nx);
  ASSERT_EQ(b.ny, a.ny);
  // The imported site's zero is the ground at its middle; float32 about 90 m resolves 8 um.
  EXPECT_NEAR(again->georeference()->height_m, origin.height_m + a.HeightAt(0, 0), 1e-4);
  for (const auto& [x, y] : {std::pair{-5.5, 3.1}, {0.25, -3.97}, {5.9, 0.04}}) {
    EXPECT_NEAR(b.HeightAt(x, y), a.HeightAt(x, y) - a.HeightAt(0, 0), 1e-4);
  }
}

TEST_F(GeotiffTest, FinerCellsInterpolateTheSameGround) {
  MakeSite("size_m: [6, 6]\ncell_m: 0.5\nrelief: {slope_deg: 8, slope_direction_deg: 30}\n")
      ->WriteGeoTiff(File("slope.tif"), GroundRaster::kHeight, {10, 20, 0}, 1);
  const auto fine = MakeSite("cell_m: 0.05\ngeotiff: " + File("slope.tif") + "\n");
  EXPECT_EQ(fine->surface().nx, 121);
  const double rise = std::tan(8 * kDeg) * (1.23 * std::cos(30 * kDeg) + 2.1 * std::sin(30 * kDeg));
  EXPECT_NEAR(fine->surface().HeightAt(1.23, 2.1), rise, 1e-4);
}

TEST_F(GeotiffTest, UnreadableFilesAreFaultsAtTheirKey) {
  EXPECT_THAT(FaultsOf("geotiff: " + File("none.tif") + "\n"), HasSubstr("does not exist"));
  std::ofstream(File("text.tif")) << "not a raster";
  EXPECT_THAT(FaultsOf("geotiff: " + File("text.tif") + "\n"),
              AllOf(HasSubstr("site.yaml:1:10: geotiff"), HasSubstr("not readable as a GeoTIFF")));
  std::ofstream(File("empty.tif"));
  EXPECT_THAT(FaultsOf("geotiff: " + File("empty.tif") + "\n"), HasSubstr("not readable"));
  MakeSite("size_m: [6, 6]\nrelief: {amplitude_m: 1}\n")
      ->WriteGeoTiff(File("cut.tif"), GroundRaster::kHeight, {1, 2, 0}, 1);
  std::filesystem::resize_file(File("cut.tif"), std::filesystem::file_size(File("cut.tif")) / 2);
  EXPECT_THAT(FaultsOf("geotiff: " + File("cut.tif") + "\n"), HasSubstr("cut.tif"));
}

/// A small float raster as an ASCII grid, which GDAL reads too: it has no projection of its own.
void WriteAsciiGrid(const std::string& file, const std::string& rows) {
  std::ofstream(file) << "ncols 3\nnrows 2\nxllcorner 500000\nyllcorner 4000000\ncellsize 1\n"
                         "NODATA_value -9999\n"
                      << rows;
}

TEST_F(GeotiffTest, NoProjectionIsAFault) {
  WriteAsciiGrid(File("plain.asc"), "1 2 3\n4 5 6\n");
  EXPECT_THAT(FaultsOf("geotiff: " + File("plain.asc") + "\n"), HasSubstr("has no projection"));
}

TEST_F(GeotiffTest, GapsAreAFault) {
  WriteAsciiGrid(File("gaps.asc"), "1 2 -9999\n4 5 6\n");
  std::ofstream(File("gaps.prj")) << "PROJCS[\"UTM 33N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\","
                                     "SPHEROID[\"WGS 84\",6378137,298.257223563]],"
                                     "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],"
                                     "PROJECTION[\"Transverse_Mercator\"],"
                                     "PARAMETER[\"latitude_of_origin\",0],"
                                     "PARAMETER[\"central_meridian\",15],"
                                     "PARAMETER[\"scale_factor\",0.9996],"
                                     "PARAMETER[\"false_easting\",500000],"
                                     "PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]";
  EXPECT_THAT(FaultsOf("geotiff: " + File("gaps.asc") + "\n"),
              HasSubstr("1 of 6 pixels have no height"));
}

TEST_F(GeotiffTest, FolderThatIsNotThereIsAnErrorAndSpoilsNoLaterFile) {
  const auto soil = MakeSite("size_m: [2, 2]\n");
  EXPECT_THROW(soil->WriteGeoTiff(File("no/such/folder.tif"), GroundRaster::kHeight, {0, 0, 0}, 1),
               InputError);
  EXPECT_NO_THROW(soil->WriteGeoTiff(File("good.tif"), GroundRaster::kHeight, {0, 0, 0}, 1));
  EXPECT_TRUE(std::filesystem::exists(File("good.tif")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);  // nothing beside
}

TEST_F(GeotiffTest, AFullDiskLeavesNoFileUnderTheFinalName) {
  // /dev/full takes no byte: the part file is a link to it.
  std::filesystem::create_symlink("/dev/full", File("full.tif.part"));
  const auto soil = MakeSite("size_m: [2, 2]\n");
  EXPECT_THROW(soil->WriteGeoTiff(File("full.tif"), GroundRaster::kHeight, {0, 0, 0}, 1),
               InputError);
  EXPECT_FALSE(std::filesystem::exists(File("full.tif")));
}

/// Twelve by eight pixels of half a metre: class 1 west, 2 east, 7 in the north-east corner pixel.
void WriteClasses(const std::string& file, GDALDataType type = GDT_Byte, bool referenced = true) {
  std::vector<std::vector<double>> rows(8, std::vector<double>(12, 1));
  for (auto& row : rows) std::fill(row.begin() + 6, row.end(), 2);
  rows[0][11] = 7;
  testing_soil::WriteUtmRaster(file, rows, 0.5, {500000, 5200000}, type, referenced);
}

std::string ClassesYaml(const std::string& file, const std::string& classes) {
  return "soil_classes: {geotiff: " + file + ", classes: [" + classes + "]}\n";
}

TEST_F(GeotiffTest, SoilClassesSayWhatLiesWhere) {
  WriteClasses(File("soil.tif"));
  const std::string classes =
      "{value: 1, soil: sand}, {value: 2, layers: [{soil: dirt, from_m: 0, to_m: 0.2}, "
      "{soil: gravel, from_m: 0.2}]}, {value: 7, soil: asphalt}";
  const SitePlan plan = Plan(ClassesYaml(File("soil.tif"), classes) + "cell_m: 0.05\n");
  // The file's middle is W's origin. UTM's scale on the central meridian is 0.9996.
  ASSERT_TRUE(plan.georeference);
  EXPECT_NEAR(plan.georeference->lon_deg, 15, 1e-4);
  EXPECT_NEAR(plan.ground.grid.cell_m * (plan.ground.grid.nx - 1), 11 * 0.5 / 0.9996, 0.05);
  const auto soil_at = [&](double x, double y, double depth_m) {
    const GroundProfile& profile = plan.ground.profiles[plan.ground.ProfileAt(Vec2(x, y))];
    return plan.soils[profile.Below(depth_m).soil].name;
  };
  EXPECT_EQ(soil_at(-0.05, 0, 0), "sand");
  EXPECT_EQ(soil_at(0.05, 0, 0), "dirt");
  EXPECT_EQ(soil_at(0.05, 0, 0.21), "gravel");
  EXPECT_EQ(soil_at(2.6, 1.6, 0), "asphalt");
  EXPECT_EQ(soil_at(2.4, 1.6, 0), "dirt");
  EXPECT_EQ(soil_at(2.6, 1.4, 0), "dirt");
}

TEST_F(GeotiffTest, SoilClassesLieWhereTheHeightsLie) {
  // The heights' file reaches 4 m further west than the classes', so that its middle, W's origin,
  // lies 2 m west of theirs.
  WriteClasses(File("soil.tif"));
  testing_soil::WriteUtmRaster(File("height.tif"), std::vector(8, std::vector<double>(20, 120.0)),
                               0.5, {499996, 5200000}, GDT_Float32);
  const SitePlan plan =
      Plan("geotiff: " + File("height.tif") + "\nsize_m: [1, 3]\ncell_m: 0.05\n" +
           ClassesYaml(File("soil.tif"),
                       "{value: 1, soil: sand}, {value: 2, soil: dirt}, {value: 7, soil: gravel}"));
  EXPECT_NEAR(plan.georeference->height_m, 120, 1e-6);
  const auto soil_at = [&](double x) {
    return plan.soils[plan.ground.profiles[plan.ground.ProfileAt(Vec2(x, 0))].Below(0).soil].name;
  };
  EXPECT_EQ(soil_at(1.95), "sand");
  EXPECT_EQ(soil_at(2.05), "dirt");
}

TEST_F(GeotiffTest, OnlyTilesWithABorderOfClassesAreSeenVertexByVertex) {
  std::vector<std::vector<double>> rows(20, std::vector<double>(40, 1));
  for (auto& row : rows) std::fill(row.begin() + 13, row.end(), 2);  // the border: x = -7 m
  testing_soil::WriteUtmRaster(File("soil.tif"), rows, 1.0);
  const auto soil =
      MakeSite(ClassesYaml(File("soil.tif"), "{value: 1, soil: sand}, {value: 2, soil: dirt}"));
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

TEST_F(GeotiffTest, FaultsOfSoilClassesAreNamed) {
  WriteClasses(File("soil.tif"));
  const std::string two = "{value: 1, soil: sand}, {value: 2, soil: dirt}";
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), two)),
              AllOf(HasSubstr("soil_classes.geotiff: 1 of 96 pixels have the value 7"),
                    HasSubstr("name its soil under classes")));
  const std::string all = two + ", {value: 7, soil: gravel}";
  EXPECT_EQ(FaultsOf(ClassesYaml(File("soil.tif"), all)), "");
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), all) + "soil: dirt\n"),
              HasSubstr("soil and soil_classes exclude each other"));
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), all + ", {value: 2, soil: sand}")),
              HasSubstr("second class of value 2"));
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), "")), HasSubstr("names no class"));
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), "{value: 300, soil: sand}")),
              HasSubstr("300 is out of range"));
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), all) + "size_m: [40, 4]\n"),
              HasSubstr("need a class for all of it"));
  WriteClasses(File("float.tif"), GDT_Float32);
  EXPECT_THAT(FaultsOf(ClassesYaml(File("float.tif"), all)),
              AllOf(HasSubstr("its pixels are Float32, need classes as Byte"),
                    HasSubstr("gdal_translate -ot Byte")));
  WriteClasses(File("nowhere.tif"), GDT_Byte, false);
  EXPECT_THAT(FaultsOf(ClassesYaml(File("nowhere.tif"), all)), HasSubstr("has no projection"));
  {
    std::unique_ptr<GDALDataset, testing_soil::ReadRaster::Close> file(
        static_cast<GDALDataset*>(GDALOpen(File("soil.tif").c_str(), GA_Update)));
    file->GetRasterBand(1)->SetNoDataValue(7);
  }
  EXPECT_THAT(FaultsOf(ClassesYaml(File("soil.tif"), two)),
              AllOf(HasSubstr("1 of 96 pixels have no class: the file's no-data value 7"),
                    HasSubstr("fill the gaps")));
}

TEST_F(GeotiffTest, WhatWasExportedComesBackAsSoilClasses) {
  const auto soil = MakeSite(
      "size_m: [8, 6]\ncell_m: 0.1\nsoils: [dirt, sand]\n"
      "regions:\n  - {outline_m: [[-2, -1], [2, -1], [0, 2]], soil: sand}\n");
  soil->WriteGeoTiff(File("soil.tif"), GroundRaster::kSoilClass, {46.8, -71.2, 80}, 1);
  const auto again =
      MakeSite("cell_m: 0.1\n" +
               ClassesYaml(File("soil.tif"), "{value: 0, soil: dirt}, {value: 1, soil: sand}"));
  const TerrainSurface &a = soil->surface(), &b = again->surface();
  ASSERT_EQ(a.nx, b.nx);
  ASSERT_EQ(a.ny, b.ny);
  for (int j = 0; j < a.ny; ++j) {
    for (int i = 0; i < a.nx; ++i) ASSERT_EQ(a.at(i, j).cover.soil, b.at(i, j).cover.soil);
  }
}

/// A plane through the middle of a UTM zone 19N raster (central meridian 69 W), given in the
/// tangent plane there, as the file's heights above the ellipsoid. GeographicLib does the geodesy.
class UtmPlane {
 public:
  static constexpr int kPixels = 61;
  static constexpr double kHeight_m = 80;
  UtmPlane(double lat_deg, double lon_deg, double cell_m, double slope_x, double slope_y)
      : cell_m_(cell_m), slope_(slope_x, slope_y) {
    int zone;
    bool north;
    GeographicLib::UTMUPS::Forward(lat_deg, lon_deg, zone, north, middle_.x(), middle_.y());
    middle_ = middle_.array().round();
    double lat, lon;
    GeographicLib::UTMUPS::Reverse(kZone, true, middle_.x(), middle_.y(), lat, lon);
    plane_.Reset(lat, lon, kHeight_m);
  }
  void Write(const std::string& stem) const {
    std::ofstream prj(stem + ".prj");
    prj << "PROJCS[\"UTM 19N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\","
           "6378137,298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],"
           "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],"
           "PARAMETER[\"central_meridian\",-69],PARAMETER[\"scale_factor\",0.9996],"
           "PARAMETER[\"false_easting\",500000],PARAMETER[\"false_northing\",0],"
           "UNIT[\"metre\",1]]";
    std::ofstream asc(stem + ".asc");
    asc.precision(12);
    const double corner_m = 0.5 * kPixels * cell_m_;
    asc << "ncols " << kPixels << "\nnrows " << kPixels << "\nxllcorner " << middle_.x() - corner_m
        << "\nyllcorner " << middle_.y() - corner_m << "\ncellsize " << cell_m_ << "\n";
    for (int row = 0; row < kPixels; ++row) {
      for (int i = 0; i < kPixels; ++i) asc << HeightOf(i, kPixels - 1 - row) << ' ';
      asc << '\n';
    }
  }

 private:
  static constexpr int kZone = 19;
  /// Height above the ellipsoid at which pixel (i, j)'s vertical meets the plane.
  double HeightOf(int i, int j) const {
    const int half = kPixels / 2;
    double lat, lon;
    GeographicLib::UTMUPS::Reverse(kZone, true, middle_.x() + (i - half) * cell_m_,
                                   middle_.y() + (j - half) * cell_m_, lat, lon);
    double height_m = kHeight_m;
    for (int k = 0; k < 6; ++k) {
      Vec3 p;
      plane_.Forward(lat, lon, height_m, p.x(), p.y(), p.z());
      height_m += slope_.dot(p.head<2>()) - p.z();
    }
    return height_m;
  }

  double cell_m_;
  Vec2 slope_, middle_;
  GeographicLib::LocalCartesian plane_;
};

TEST_F(GeotiffTest, NorthIsTrueNorthWellOffTheCentralMeridian) {
  // Quebec, 2.27 degrees west of the meridian: the grid's north lies 1.65 degrees off, 0.6 m at 20
  // m.
  UtmPlane(46.78, -71.27, 1.0, 0.3, 0.2).Write(File("quebec"));
  const auto soil = MakeSite("cell_m: 0.5\ngeotiff: " + File("quebec.asc") + "\n");
  ASSERT_TRUE(soil->georeference());
  EXPECT_NEAR(soil->georeference()->lat_deg, 46.78, 1e-5);
  EXPECT_NEAR(soil->georeference()->lon_deg, -71.27, 1e-5);
  EXPECT_NEAR(soil->georeference()->height_m, UtmPlane::kHeight_m, 1e-4);
  for (const auto& [x, y] : {std::pair{20.0, 0.0}, {0.0, 20.0}, {-17.0, 11.0}, {25.0, -25.0}}) {
    EXPECT_NEAR(soil->surface().HeightAt(x, y), 0.3 * x + 0.2 * y, 2e-4) << x << ' ' << y;
  }
}

TEST_F(GeotiffTest, AWideSiteFallsAwayWithTheEllipsoid) {
  // At 280 m the ellipsoid lies 6 mm below the tangent plane.
  UtmPlane(46.78, -71.27, 10.0, 0.02, -0.01).Write(File("wide"));
  const auto soil = MakeSite("cell_m: 1\ngeotiff: " + File("wide.asc") + "\n");
  for (const auto& [x, y] : {std::pair{280.0, 0.0}, {0.0, -280.0}, {-200.0, 190.0}}) {
    EXPECT_NEAR(soil->surface().HeightAt(x, y), 0.02 * x - 0.01 * y, 5e-4) << x << ' ' << y;
  }
}

}  // namespace
}  // namespace tera
