#include "soil/site/map_raster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "geotiff_fixture.h"
#include "site_fixture.h"
#include "soil/site/ground_raster.h"

namespace tera {
namespace {

using enum FaultKind;
using testing_soil::FolderTest;

class MapRasterTest : public FolderTest {};

constexpr SiteOrigin kMapRasterQuebec{46.81, -71.21, 87.5};

/// 12 x 8 m at 10 cm, that rises towards one side by 5 deg: 121 x 81 columns.
Columns Slope() {
  return BuildColumns(
      testing_soil::Plan("size_m: [12, 8]\ncell_m: 0.1\nsoils: [dirt]\nrelief: {slope_deg: 5}\n"));
}

TEST_F(MapRasterTest, HeightsComeBackAsTheyStandInTheWorld) {
  const Columns ground = Slope();
  WriteGroundRaster(File("height.tif"), ground, GroundRaster::kHeight, kMapRasterQuebec, 1);
  const SiteMap map = ReadSiteHeights(File("height.tif"), kMapRasterQuebec, 200);
  ASSERT_EQ(map.nx, 121);
  ASSERT_EQ(map.ny, 81);
  EXPECT_NEAR(map.square_m, 0.1, 1e-12);
  EXPECT_NEAR(map.low_W_m.x(), ground.x_m(0) - 0.05, 1e-9);
  EXPECT_NEAR(map.low_W_m.y(), ground.y_m(0) - 0.05, 1e-9);
  // As float32 about 88 m: to 4e-6 m.
  for (const auto& [i, j] : {std::pair(0, 0), {120, 0}, {0, 80}, {70, 20}}) {
    EXPECT_NEAR(map.values[static_cast<std::size_t>(j) * 121 + i], ground.TopAt(i, j), 1e-5);
  }
  EXPECT_GT(std::abs(ground.TopAt(0, 0) - ground.TopAt(120, 80)), 0.5);
}

TEST_F(MapRasterTest, OfTooManyPixelsSquaresHoldTheMean) {
  const Columns ground = Slope();
  WriteGroundRaster(File("height.tif"), ground, GroundRaster::kHeight, kMapRasterQuebec, 1);
  const SiteMap map = ReadSiteHeights(File("height.tif"), kMapRasterQuebec, 61);
  ASSERT_EQ(map.nx, 60);  // 121 columns make 60 squares of two
  ASSERT_EQ(map.ny, 40);
  EXPECT_NEAR(map.square_m, 0.2, 1e-12);
  // The southernmost row is left out: the first square covers the rows 1 and 2.
  EXPECT_NEAR(map.low_W_m.y(), ground.y_m(1) - 0.05, 1e-9);
  const double mean_m =
      (ground.TopAt(10, 1) + ground.TopAt(11, 1) + ground.TopAt(10, 2) + ground.TopAt(11, 2)) / 4;
  EXPECT_NEAR(map.values[5], mean_m, 1e-4);
}

TEST_F(MapRasterTest, ScaleAndOffsetOfTheBandAreApplied) {
  const Columns ground = Slope();
  WriteGroundRaster(File("height.tif"), ground, GroundRaster::kHeight, kMapRasterQuebec, 1);
  testing_soil::EditBand(File("height.tif"), [](GDALRasterBand* band) {
    band->SetScale(2);
    band->SetOffset(-kMapRasterQuebec.height_m);
  });
  const SiteMap map = ReadSiteHeights(File("height.tif"), kMapRasterQuebec, 200);
  EXPECT_NEAR(map.values[0], 2 * ground.TopAt(0, 0), 1e-4);
}

TEST_F(MapRasterTest, AnotherProjectionOrNoRasterIsRefused) {
  WriteGroundRaster(File("height.tif"), Slope(), GroundRaster::kHeight, kMapRasterQuebec, 1);
  SiteOrigin other = kMapRasterQuebec;
  other.lon_deg += 0.001;
  EXPECT_THAT([&] { ReadSiteMap(File("height.tif"), other, 100); }, ThrowsFault(kInconsistent));
  EXPECT_THAT([&] { ReadSiteMap(File("none.tif"), kMapRasterQuebec, 100); },
              ThrowsFault(kUnreadable, "none.tif"));
  testing_soil::WriteUtmRaster(File("bare.tif"), {{1, 2}, {3, 4}}, 1, {0, 0}, GDT_Byte,
                               /*referenced=*/false);
  EXPECT_THAT([&] { ReadSiteMap(File("bare.tif"), kMapRasterQuebec, 100); },
              ThrowsFault(kMissing, "bare.tif"));
}

}  // namespace
}  // namespace tera
