#include "soil/site/site.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/faults.h"
#include "site_fixture.h"

namespace tera {
namespace {

using enum FaultKind;
using namespace testing_soil;

TEST(Site, DefaultsAreFortyMetresOfDirtCentredOnTheOrigin) {
  const Site site = SiteOf("{}");
  const TerrainSurface& ground = site.surface();
  EXPECT_EQ(ground.nx, 801);
  EXPECT_EQ(ground.ny, 801);
  EXPECT_EQ(ground.origin_W_m, Vec2(-20, -20));
  ASSERT_EQ(site.soils().size(), 1u);
  EXPECT_EQ(site.soils()[0].name, "dirt");
  EXPECT_FALSE(site.georeference());
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
    EXPECT_EQ(plan.kinds.soils()[0].name, name);
  }
}

TEST(Site, StrengthUnderRunningGearIsItsOwnOrThatOfTheGround) {
  const SoilType sand = Plan("size_m: [2, 2]\nsoil: sand\n").kinds.soils()[0];
  EXPECT_NEAR(sand.friction_angle_rad, 39 * kDeg, 1e-12);
  EXPECT_NEAR(sand.shear_friction_rad, 28 * kDeg, 1e-12);
  EXPECT_EQ(sand.cohesion_pa, 0);
  EXPECT_EQ(sand.shear_cohesion_pa, 1040);
  const SoilType clay = Plan("size_m: [2, 2]\nsoil: clay\n").kinds.soils()[0];
  EXPECT_NEAR(clay.shear_friction_rad, 13 * kDeg, 1e-12);
  EXPECT_EQ(clay.shear_cohesion_pa, 4140);
}

TEST(Site, StripsSetTheSoilAlongTheirAxis) {
  const auto soil = MakeGround(
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
  EXPECT_EQ(SoilAt(plan, -5, 0, 0), "dirt");
  EXPECT_EQ(SoilAt(plan, -5, 0, 0.31), "gravel");
  EXPECT_EQ(SoilAt(plan, 0, 0, 0), "sand");
  EXPECT_EQ(SoilAt(plan, 0, 0, 4), "sand");
  EXPECT_EQ(SoilAt(plan, 1.5, 1.5, 0), "dirt");  // in the triangle's box, outside its sides
  const GroundProfile& layers = plan.ground.profiles[0];
  EXPECT_NEAR(layers.Mass_kgpm2(0.1, 0.5), 0.2 * 1474 + 0.2 * 1590, 1e-9);
  EXPECT_FLOAT_EQ(layers.Below(0).moisture, 0.7f);
}

TEST(Site, ARegionIsSeenWithItsExactOutline) {
  const auto soil = MakeGround(
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
  const auto soil = MakeGround(
      "size_m: [10, 10]\nsoil: dirt\npiles: [{xy_m: [1, -2], height_m: 1.0, soil: gravel}]\n");
  const TerrainSurface& ground = soil->surface();
  EXPECT_NEAR(ground.HeightAt(1, -2), 1.0, 1e-6);
  EXPECT_NEAR(ground.HeightAt(1 + 0.8, -2), 1.0 - 0.8 * std::tan(32 * kDeg), 1e-3);
  EXPECT_EQ(soil->soils()[ground.at(120, 60).cover.soil].name, "gravel");
  for (int k = 0; k < 500; ++k) soil->Flow(0.002);
  EXPECT_NEAR(ground.HeightAt(1, -2), 1.0, 0.03);
}

TEST(Site, ABermIsARidgeFromEndToEndWhoseCrestFollowsTheGround) {
  const double slope = 0.1, height_m = 0.8;
  const auto soil = MakeGround(
      "size_m: [16, 10]\ncell_m: 0.05\nsoil: dirt\nrelief: {slope_deg: 5.710593, "
      "slope_direction_deg: 0}\npiles: [{xy_m: [-4, 1], to_m: [4, 1], height_m: 0.8, soil: "
      "gravel}]\n");
  const TerrainSurface& ground = soil->surface();
  for (const double x_m : {-4.0, -1.5, 0.0, 3.0, 4.0}) {
    EXPECT_NEAR(ground.HeightAt(x_m, 1), slope * x_m + height_m, 2e-3) << x_m;
  }
  // Gravel rests at 32 deg: beside the crest its side falls by tan 32 deg, beyond the end too.
  const double fall = std::tan(32 * kDeg);
  EXPECT_NEAR(ground.HeightAt(1, 1.5), slope * 1 + height_m - 0.5 * fall, 2e-3);
  EXPECT_NEAR(ground.HeightAt(1, 0.2), slope * 1 + height_m - 0.8 * fall, 2e-3);
  EXPECT_NEAR(ground.HeightAt(4.5, 1), slope * 4 + height_m - 0.5 * fall, 2e-3);
  EXPECT_NEAR(ground.HeightAt(0, 3), 0, 1e-6);
}

TEST(Site, EveryFaultOfATerrainIsNamed) {
  EXPECT_THAT(FaultsOf("soil: drt\n"), HasFault(kNoSuchName, "site.yaml:1:7: soil"));
  EXPECT_THAT(FaultsOf("sise_m: [1, 1]\n"), HasFault(kUnknown, "sise_m"));
  EXPECT_THAT(FaultsOf("cell_m: 0\n"), HasFault(kOutOfRange, "cell_m"));
  EXPECT_THAT(FaultsOf("size_m: [2000, 2000]\ncell_m: 0.01\n"), HasFault(kOutOfRange, "size_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nstrips: [{soil: sand, from_m: 2, to_m: 1}]\n"),
              HasFault(kInconsistent, "to_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nstrips:\n  - {soil: sand, from_m: 0, to_m: 2}\n"
                       "  - {soil: dirt, from_m: 1, to_m: 3}\n"),
              HasFault(kInconsistent, "from_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\npiles: [{xy_m: [0, 0], height_m: -1, soil: sand}]\n"),
              HasFault(kOutOfRange, "piles[0].height_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\npiles: [{xy_m: [0, 2.1], height_m: 1, soil: sand}]\n"),
              HasFault(kOutOfRange, "piles[0].xy_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\npiles: [{xy_m: [0, 0], to_m: [3, 0], height_m: 1, soil: "
                       "sand}]\n"),
              HasFault(kOutOfRange, "piles[0].to_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nlayers:\n  - {soil: dirt, from_m: 0, to_m: 0.4}\n"
                       "  - {soil: sand, from_m: 0.3}\n"),
              HasFault(kInconsistent, "layers[1].from_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nlayers:\n  - {soil: dirt, from_m: 0, to_m: 0.4}\n"
                       "  - {soil: sand, from_m: 0.5}\n"),
              HasFault(kInconsistent, "from_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nsoil: dirt\nlayers: [{soil: dirt, from_m: 0}]\n"),
              HasFault(kInconsistent, "soil"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nlayers: [{soil: dirt, from_m: 0, to_m: 1}]\n"),
              HasFault(kInconsistent, "to_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nregions:\n"
                       "  - {outline_m: [[0, 0], [1, 1], [1, 0], [0, 1]], soil: sand}\n"),
              HasFault(kInconsistent, "outline_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nregions:\n"
                       "  - {outline_m: [[0, 0], [1, 1], [2, 2]], soil: sand}\n"),
              HasFault(kInconsistent, "outline_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nregions:\n"
                       "  - {outline_m: [[0, 0], [1, 1]], soil: sand}\n"),
              HasFault(kInconsistent, "outline_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\nlayers: [{soil: dirt, from_m: 0, density_kgpm3: 2500}]\n"),
              HasFault(kOutOfRange, "density_kgpm3"));
  const std::string dirt =
      "size_m: [4, 4]\nsoil: mine\ncustom_soils:\n  - {preset: "
      "tera:config/soils/dirt.yaml, name: mine, ";
  EXPECT_THAT(FaultsOf(dirt + "cohesion_pa: 10}\n"), testing::IsEmpty());
  EXPECT_THAT(FaultsOf(dirt + "moisture: 1.2}\n"),
              HasFault(kOutOfRange, "custom_soils[0].moisture"));
  EXPECT_THAT(FaultsOf(dirt + "friction_angle_deg: 0, cohesion_pa: 0}\n"),
              HasFault(kOutOfRange, "custom_soils[0].friction_angle_deg"));
  EXPECT_THAT(FaultsOf(dirt + "shear_friction_deg: 0, shear_cohesion_pa: 0}\n"),
              HasFault(kOutOfRange, "custom_soils[0].shear_friction_deg"));
  EXPECT_THAT(FaultsOf(dirt + "texture: mud}\n"), HasFault(kNoSuchName, "custom_soils[0].texture"));
  EXPECT_THAT(FaultsOf(dirt + "bank_density_kgpm3: -5}\n"),
              HasFault(kOutOfRange, "bank_density_kgpm3"));
  EXPECT_THAT(FaultsOf(dirt + "friction_angle_deg: 90}\n"),
              HasFault(kOutOfRange, "friction_angle_deg"));
  EXPECT_THAT(FaultsOf(dirt + "shear_friction_deg: 90}\n"),
              HasFault(kOutOfRange, "shear_friction_deg"));
  EXPECT_THAT(FaultsOf(dirt + "shear_cohesion_pa: -1}\n"),
              HasFault(kOutOfRange, "shear_cohesion_pa"));
  EXPECT_THAT(FaultsOf(dirt + "max_density_kgpm3: 1000}\n"),
              HasFault(kInconsistent, "max_density_kgpm3"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\ncustom_soils:\n"
                       "  - {preset: tera:config/soils/dirt.yaml}\n"
                       "  - {preset: tera:config/soils/dirt.yaml}\n"),
              HasFault(kRepeated, "name"));
}

}  // namespace
}  // namespace tera
