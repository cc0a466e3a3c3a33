#include "soil/site/geotiff.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/faults.h"
#include "geotiff_fixture.h"
#include "site_fixture.h"

// Elevation files: written heights come back, and lie where geodesy puts them.

namespace tera {
namespace {

using enum FaultKind;
using namespace testing_soil;

class GeotiffTest : public FolderTest {};

TEST_F(GeotiffTest, HeightsAndPlaceSurviveARoundTrip) {
  const auto soil =
      MakeGround("size_m: [12, 8]\ncell_m: 0.1\nrelief: {amplitude_m: 0.5, wavelength_m: 4}\n");
  const SiteOrigin origin{46.81, -71.21, 87.5};
  soil->WriteGeoTiff(File("site.tif"), GroundRaster::kHeight, origin, 1);
  const Site again = SiteOf("cell_m: 0.1\ngeotiff: " + File("site.tif") + "\n");
  ASSERT_TRUE(again.georeference());
  EXPECT_NEAR(again.georeference()->lat_deg, origin.lat_deg, 1e-9);
  EXPECT_NEAR(again.georeference()->lon_deg, origin.lon_deg, 1e-9);
  const TerrainSurface &a = soil->surface(), &b = again.surface();
  ASSERT_EQ(b.nx, a.nx);
  ASSERT_EQ(b.ny, a.ny);
  // The imported site's zero is the ground at its middle; float32 about 90 m resolves 8 um.
  EXPECT_NEAR(again.georeference()->height_m, origin.height_m + a.HeightAt(0, 0), 1e-4);
  for (const auto& [x, y] : {std::pair{-5.5, 3.1}, {0.25, -3.97}, {5.9, 0.04}}) {
    EXPECT_NEAR(b.HeightAt(x, y), a.HeightAt(x, y) - a.HeightAt(0, 0), 1e-4);
  }
}

TEST_F(GeotiffTest, FinerCellsInterpolateTheSameGround) {
  MakeGround("size_m: [6, 6]\ncell_m: 0.5\nrelief: {slope_deg: 8, slope_direction_deg: 30}\n")
      ->WriteGeoTiff(File("slope.tif"), GroundRaster::kHeight, {10, 20, 0}, 1);
  const auto fine = MakeGround("cell_m: 0.05\ngeotiff: " + File("slope.tif") + "\n");
  EXPECT_EQ(fine->surface().nx, 121);
  const double rise = std::tan(8 * kDeg) * (1.23 * std::cos(30 * kDeg) + 2.1 * std::sin(30 * kDeg));
  EXPECT_NEAR(fine->surface().HeightAt(1.23, 2.1), rise, 1e-4);
}

TEST_F(GeotiffTest, UnreadableFilesAreFaultsAtTheirKey) {
  EXPECT_THAT(FaultsOf("geotiff: " + File("none.tif") + "\n"), HasFault(kUnreadable, "geotiff"));
  std::ofstream(File("text.tif")) << "not a raster";
  EXPECT_THAT(FaultsOf("geotiff: " + File("text.tif") + "\n"), HasFault(kUnreadable, "text.tif"));
  std::ofstream(File("empty.tif"));
  EXPECT_THAT(FaultsOf("geotiff: " + File("empty.tif") + "\n"), HasFault(kUnreadable, "empty.tif"));
  MakeGround("size_m: [6, 6]\nrelief: {amplitude_m: 1}\n")
      ->WriteGeoTiff(File("cut.tif"), GroundRaster::kHeight, {1, 2, 0}, 1);
  std::filesystem::resize_file(File("cut.tif"), std::filesystem::file_size(File("cut.tif")) / 2);
  EXPECT_THAT(FaultsOf("geotiff: " + File("cut.tif") + "\n"), HasFaultAt("cut.tif"));
}

/// The reference system of an ASCII grid, in a file beside it.
void WriteUtmProjection(const std::string& file, int zone) {
  std::ofstream(file)
      << "PROJCS[\"UTM\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,"
         "298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],"
         "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],"
         "PARAMETER[\"central_meridian\","
      << 6 * zone - 183
      << "],PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],"
         "PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]";
}

/// A small float raster as an ASCII grid, which GDAL reads too: it has no projection of its own.
void WriteAsciiGrid(const std::string& file, const std::string& rows) {
  std::ofstream(file) << "ncols 3\nnrows 2\nxllcorner 500000\nyllcorner 4000000\ncellsize 1\n"
                         "NODATA_value -9999\n"
                      << rows;
}

TEST_F(GeotiffTest, NoProjectionIsAFault) {
  WriteAsciiGrid(File("plain.asc"), "1 2 3\n4 5 6\n");
  EXPECT_THAT(FaultsOf("geotiff: " + File("plain.asc") + "\n"), HasFault(kMissing, "plain.asc"));
}

TEST_F(GeotiffTest, GapsAreAFault) {
  WriteAsciiGrid(File("gaps.asc"), "1 2 -9999\n4 5 6\n");
  WriteUtmProjection(File("gaps.prj"), 33);
  EXPECT_THAT(FaultsOf("geotiff: " + File("gaps.asc") + "\n"), HasFault(kMissing, "gaps.asc"));
}

/// Eight by eight pixels of a metre that rise by 10 units a pixel to the east, from `first`.
std::vector<std::vector<double>> Rising(double first) {
  std::vector<std::vector<double>> rows(8);
  for (auto& row : rows) {
    for (int i = 0; i < 8; ++i) row.push_back(first + 10.0 * i);
  }
  return rows;
}

// 0.1 times 4000 to 4070 plus 20: 420 to 427 m, a slope of one; the plane's unit of length is the
// metre but for UTM's scale, 0.9996.
TEST_F(GeotiffTest, ScaleAndOffsetOfTheBandAreApplied) {
  WriteUtmRaster(File("dm.tif"), Rising(4000), 1, {500000, 5200000}, GDT_Int16);
  EditBand(File("dm.tif"), [](GDALRasterBand* band) {
    band->SetScale(0.1);
    band->SetOffset(20);
  });
  const Site site = SiteOf("cell_m: 0.5\ngeotiff: " + File("dm.tif") + "\n");
  EXPECT_NEAR(site.georeference()->height_m, 423.5, 1e-3);
  EXPECT_NEAR(site.surface().HeightAt(3, 1) - site.surface().HeightAt(-3, 1), 6, 0.01);
}

TEST_F(GeotiffTest, HeightsInFeetBecomeMetres) {
  for (const auto& [unit, metres] : {std::pair("ft", 0.3048), {"US survey foot", 1200.0 / 3937}}) {
    WriteUtmRaster(File("feet.tif"), Rising(1000), 1, {500000, 5200000}, GDT_Float32);
    EditBand(File("feet.tif"), [&](GDALRasterBand* band) { band->SetUnitType(unit); });
    const Site site = SiteOf("cell_m: 0.5\ngeotiff: " + File("feet.tif") + "\n");
    EXPECT_NEAR(site.georeference()->height_m, 1035 * metres, 1e-4) << unit;
  }
  EditBand(File("feet.tif"), [](GDALRasterBand* band) { band->SetUnitType("fathom"); });
  EXPECT_THAT(FaultsOf("geotiff: " + File("feet.tif") + "\n"), HasFault(kUnsupported, "feet.tif"));
}

TEST_F(GeotiffTest, AMapInFeetMustNameTheUnitOfItsHeights) {
  WriteUtmRaster(File("ny.tif"), Rising(100), 1, {980000, 200000}, GDT_Float32);
  {
    std::unique_ptr<GDALDataset, ReadRaster::Close> dataset(
        static_cast<GDALDataset*>(GDALOpen(File("ny.tif").c_str(), GA_Update)));
    OGRSpatialReference new_york;
    ASSERT_EQ(new_york.importFromEPSG(2263), OGRERR_NONE);
    dataset->SetSpatialRef(&new_york);
  }
  EXPECT_THAT(FaultsOf("geotiff: " + File("ny.tif") + "\n"), HasFault(kUnsupported, "ny.tif"));
  EditBand(File("ny.tif"), [](GDALRasterBand* band) { band->SetUnitType("us-ft"); });
  const Site site = SiteOf("cell_m: 0.1\ngeotiff: " + File("ny.tif") + "\n");
  EXPECT_NEAR(site.georeference()->height_m, 135 * 1200.0 / 3937, 1e-4);
}

TEST_F(GeotiffTest, NoDataThatIsNotMarkedIsNoPit) {
  const auto fault = [&](double first, double pixel, GDALDataType type) {
    auto rows = Rising(first);
    rows[2][5] = rows[2][6] = rows[3][5] = pixel;
    WriteUtmRaster(File("gap.tif"), rows, 1, {500000, 5200000}, type);
    return FaultsOf("geotiff: " + File("gap.tif") + "\n");
  };
  for (const double pixel : {-9999.0, -32768.0, 32767.0, 0.0}) {
    EXPECT_THAT(fault(420, pixel, GDT_Int16), HasFault(kUnsupported));
  }
  for (const double pixel : {-3.4028234663852886e38, 1e30, -99999.0}) {
    EXPECT_THAT(fault(420, pixel, GDT_Float32), HasFault(kUnsupported));
  }
}

// Numbers that stand for no height are a pit of a mountain side's relief as well.
TEST_F(GeotiffTest, NoDataThatIsNotMarkedIsNoPitOfWideRelief) {
  for (const double pixel : {-9999.0, -999.0, 0.0}) {
    std::vector<std::vector<double>> rows(8, std::vector<double>(8));
    for (int k = 0; k < 64; ++k) rows[k / 8][k % 8] = 300 + 12 * k;  // to 1056 m
    rows[3][3] = rows[3][4] = pixel;
    WriteUtmRaster(File("mountain.tif"), rows, 50, {500000, 5200000}, GDT_Float32);
    EXPECT_THAT(FaultsOf("geotiff: " + File("mountain.tif") + "\n"), HasFault(kUnsupported))
        << pixel;
  }
}

// A quarry's floor, a terrace, a tower and the sea below a cliff lie at one height each.
TEST_F(GeotiffTest, ALevelPlaceFarBelowOrAboveTheOthersIsGround) {
  const auto fault = [&](double first, double level) {
    auto rows = Rising(first);
    for (auto& row : rows) std::fill(row.begin(), row.begin() + 5, level);
    WriteUtmRaster(File("step.tif"), rows, 1, {500000, 5200000}, GDT_Float32);
    return FaultsOf("geotiff: " + File("step.tif") + "\n");
  };
  for (const auto& [others, level] : {std::pair{420.0, 380.0},
                                      {420.0, 360.0},
                                      {420.0, 120.0},
                                      {420.0, 800.0},
                                      {-30.0, -390.0},
                                      {30.0, 0.0},
                                      {0.0, 160.0}}) {
    EXPECT_THAT(fault(others, level), testing::IsEmpty()) << others << ' ' << level;
  }
}

TEST_F(GeotiffTest, TwoLevelsAreGround) {
  const auto fault = [&](double low, double high) {
    std::vector<std::vector<double>> rows(8, std::vector<double>(8, low));
    for (auto& row : rows) std::fill(row.begin() + 3, row.end(), high);
    WriteUtmRaster(File("levels.tif"), rows, 1, {500000, 5200000}, GDT_Float32);
    return FaultsOf("geotiff: " + File("levels.tif") + "\n");
  };
  EXPECT_THAT(fault(100, 175), testing::IsEmpty());
  EXPECT_THAT(fault(1250, 1400.5), testing::IsEmpty());
  EXPECT_THAT(fault(-9999, 420), HasFault(kUnsupported));
}

// The sea below a cliff of 150 m, by one who has marked what is no height.
TEST_F(GeotiffTest, ZeroIsAHeightWhereAnotherNumberIsMarked) {
  auto rows = Rising(150);
  rows[2][5] = rows[2][6] = rows[3][5] = 0;
  WriteUtmRaster(File("sea.tif"), rows, 1, {500000, 5200000}, GDT_Float32);
  EXPECT_THAT(FaultsOf("geotiff: " + File("sea.tif") + "\n"), HasFault(kUnsupported, "sea.tif"));
  EditBand(File("sea.tif"), [](GDALRasterBand* band) { band->SetNoDataValue(-9999); });
  EXPECT_THAT(FaultsOf("geotiff: " + File("sea.tif") + "\n"), testing::IsEmpty());
}

TEST_F(GeotiffTest, MostPixelsMayBeNoDataThatIsNotMarked) {
  auto rows = Rising(420);
  for (auto& row : rows) std::fill(row.begin(), row.begin() + 6, -9999);
  WriteUtmRaster(File("strip.tif"), rows, 1, {500000, 5200000}, GDT_Float32);
  EXPECT_THAT(FaultsOf("geotiff: " + File("strip.tif") + "\n"),
              HasFault(kUnsupported, "strip.tif"));
}

TEST_F(GeotiffTest, TheRemedyNamesTheNumberThatTheFileHolds) {
  auto rows = Rising(4000);
  rows[1][1] = -9999;
  WriteUtmRaster(File("dm.tif"), rows, 1, {500000, 5200000}, GDT_Int16);
  EditBand(File("dm.tif"), [](GDALRasterBand* band) { band->SetScale(0.5); });
  EXPECT_THAT(FaultsOf("geotiff: " + File("dm.tif") + "\n"), HasFault(kUnsupported, "dm.tif"));
}

// Bilinear warping mixes them with the heights beside.
TEST_F(GeotiffTest, NoDataMixedWithHeightsIsAFault) {
  auto rows = Rising(420);
  rows[3] = {420, -2100, -4700, -9999, -7500, -4700, -2100, 490};
  WriteUtmRaster(File("mixed.tif"), rows, 1, {500000, 5200000}, GDT_Float32);
  EXPECT_THAT(FaultsOf("geotiff: " + File("mixed.tif") + "\n"),
              HasFault(kUnsupported, "mixed.tif"));
}

TEST_F(GeotiffTest, HeightsInMillimetresAreAFault) {
  WriteUtmRaster(File("mm.tif"), Rising(420'000), 1, {500000, 5200000}, GDT_Float32);
  EXPECT_THAT(FaultsOf("geotiff: " + File("mm.tif") + "\n"), HasFault(kUnsupported, "mm.tif"));
  EditBand(File("mm.tif"), [](GDALRasterBand* band) { band->SetUnitType("mm"); });
  EXPECT_THAT(FaultsOf("geotiff: " + File("mm.tif") + "\n"), testing::IsEmpty());
}

TEST_F(GeotiffTest, PixelsThatAMaskLeavesOutHaveNoHeight) {
  WriteUtmRaster(File("masked.tif"), Rising(420), 1, {500000, 5200000}, GDT_Float32);
  EditBand(File("masked.tif"), [](GDALRasterBand* band) {
    ASSERT_EQ(band->CreateMaskBand(GMF_PER_DATASET), CE_None);
    std::vector<std::uint8_t> valid(64, 255);
    valid[9] = valid[10] = 0;
    ASSERT_EQ(
        band->GetMaskBand()->RasterIO(GF_Write, 0, 0, 8, 8, valid.data(), 8, 8, GDT_Byte, 0, 0),
        CE_None);
  });
  EXPECT_THAT(FaultsOf("geotiff: " + File("masked.tif") + "\n"), HasFault(kMissing, "masked.tif"));
}

TEST_F(GeotiffTest, FolderThatIsNotThereIsAnErrorAndSpoilsNoLaterFile) {
  const auto soil = MakeGround("size_m: [2, 2]\n");
  EXPECT_THROW(soil->WriteGeoTiff(File("no/such/folder.tif"), GroundRaster::kHeight, {0, 0, 0}, 1),
               InputError);
  EXPECT_NO_THROW(soil->WriteGeoTiff(File("good.tif"), GroundRaster::kHeight, {0, 0, 0}, 1));
  EXPECT_TRUE(std::filesystem::exists(File("good.tif")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);  // nothing beside
}

TEST_F(GeotiffTest, AFullDiskLeavesNoFileUnderTheFinalName) {
  // /dev/full takes no byte: the part file is a link to it.
  std::filesystem::create_symlink("/dev/full", File("full.tif.part"));
  const auto soil = MakeGround("size_m: [2, 2]\n");
  EXPECT_THROW(soil->WriteGeoTiff(File("full.tif"), GroundRaster::kHeight, {0, 0, 0}, 1),
               InputError);
  EXPECT_FALSE(std::filesystem::exists(File("full.tif")));
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
    WriteUtmProjection(stem + ".prj", kZone);
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
  const Site site = SiteOf("cell_m: 0.5\ngeotiff: " + File("quebec.asc") + "\n");
  ASSERT_TRUE(site.georeference());
  EXPECT_NEAR(site.georeference()->lat_deg, 46.78, 1e-5);
  EXPECT_NEAR(site.georeference()->lon_deg, -71.27, 1e-5);
  EXPECT_NEAR(site.georeference()->height_m, UtmPlane::kHeight_m, 1e-4);
  for (const auto& [x, y] : {std::pair{20.0, 0.0}, {0.0, 20.0}, {-17.0, 11.0}, {25.0, -25.0}}) {
    EXPECT_NEAR(site.surface().HeightAt(x, y), 0.3 * x + 0.2 * y, 2e-4) << x << ' ' << y;
  }
}

TEST_F(GeotiffTest, AWideSiteFallsAwayWithTheEllipsoid) {
  // At 280 m the ellipsoid lies 6 mm below the tangent plane.
  UtmPlane(46.78, -71.27, 10.0, 0.02, -0.01).Write(File("wide"));
  const auto soil = MakeGround("cell_m: 1\ngeotiff: " + File("wide.asc") + "\n");
  for (const auto& [x, y] : {std::pair{280.0, 0.0}, {0.0, -280.0}, {-200.0, 190.0}}) {
    EXPECT_NEAR(soil->surface().HeightAt(x, y), 0.02 * x - 0.01 * y, 5e-4) << x << ' ' << y;
  }
}

}  // namespace
}  // namespace tera
