#include "soil/site/survey_raster.h"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <limits>

#include "core/faults.h"
#include "own_folder.h"
#include "soil/site/geotiff.h"
#include "soil/site/geotiff_fixture.h"

// Elevations of surveys, with gaps, in maps that geodesy knows.

namespace tera {
namespace {

using enum FaultKind;
using testing::HasSubstr;

std::vector<InputFault> FaultOf(const std::function<void()>& run) {
  return FaultsIn([&] { run(); });
}

TEST(MapReference, OfACodeIsAPlaneInMetres) {
  const auto map = ReadMapReference("here", "EPSG:32632");
  ASSERT_TRUE(map);
  EXPECT_EQ(map->name, "WGS 84 / UTM zone 32N");
  EXPECT_EQ(map->vertical, "");
  const auto with_heights = ReadMapReference("here", "EPSG:32632+5773");
  ASSERT_TRUE(with_heights);
  EXPECT_THAT(with_heights->vertical, HasSubstr("EGM96"));
  EXPECT_EQ(with_heights->name, map->name);
}

TEST(MapReference, WhatIsNoPlaneInMetresIsRefused) {
  const auto fault = [](const std::string& definition) {
    return FaultOf([&] { ReadMapReference("a.las", definition); });
  };
  EXPECT_THAT(fault("EPSG:4326"), HasFault(kInconsistent, "a.las"));
  EXPECT_THAT(fault("EPSG:2263"), HasFault(kInconsistent, "a.las"));  // New York, feet
  EXPECT_THAT(fault("no such thing"), HasFault(kMalformed));
  EXPECT_THAT(fault("/etc/hostname"), HasFault(kMalformed));
  EXPECT_THAT(fault(""), HasFault(kMalformed));
  EXPECT_FALSE(ReadMapReference("a.las",
                                "LOCAL_CS[\"Site\",LOCAL_DATUM[\"Site\",0],"
                                "UNIT[\"metre\",1],AXIS[\"East\",EAST]]"));
}

TEST(MapReference, APlaceFarFromWhereTheMapIsForIsRefused) {
  const auto map = ReadMapReference("here", "EPSG:32632");
  RequireOnMap("a.las", *map, Vec2(600'000, 5'250'000));
  RequireOnMap("a.las", *map, Vec2(90'000, 5'250'000));  // a little into the zone beside
  const auto fault = [&](const Vec2& at_m) {
    return FaultOf([&] { RequireOnMap("a.las", *map, at_m); });
  };
  EXPECT_THAT(fault(Vec2(2'600'000, 1'200'000)),  // Bern in LV95
              HasFault(kInconsistent, "a.las"));
  EXPECT_THAT(fault(Vec2(5'250'000, 600'000)), HasFault(kInconsistent, "a.las"));
  EXPECT_THAT(fault(Vec2(6e8, 5.25e9)), HasFault(kInconsistent, "a.las"));  // millimetres
}

TEST(MapReference, PlacesOfAMapLieInWWhereGeodesySays) {
  // Quebec, 2.3 deg of longitude off the zone's meridian: north is turned by 1.7 deg.
  const SiteOrigin origin{46.78, -71.27, 90};
  int zone = 0;
  bool north = true;
  double easting = 0, northing = 0;
  GeographicLib::UTMUPS::Forward(origin.lat_deg, origin.lon_deg, zone, north, easting, northing);
  ASSERT_EQ(zone, 19);
  const auto map = ReadMapReference("here", "EPSG:32619");
  const std::vector<Vec2> places = {{easting, northing}, {easting + 120, northing - 75}};
  const auto in_W = PlacesInW(*map, origin, places);
  EXPECT_NEAR(in_W[0].norm(), 0, 1e-4);
  double lat_deg = 0, lon_deg = 0;
  GeographicLib::UTMUPS::Reverse(zone, north, places[1].x(), places[1].y(), lat_deg, lon_deg);
  const GeographicLib::LocalCartesian plane(origin.lat_deg, origin.lon_deg, 0);
  double x = 0, y = 0, z = 0;
  plane.Forward(lat_deg, lon_deg, 0, x, y, z);
  EXPECT_NEAR(in_W[1].x(), x, 1e-3);
  EXPECT_NEAR(in_W[1].y(), y, 1e-3);
  EXPECT_GT((in_W[1] - Vec2(120, -75)).norm(), 2);  // which a plain shift would miss
}

TEST(SurveyRaster, PixelsComeBackAsPointsAndGapsAreCounted) {
  const auto map = ReadMapReference("here", "EPSG:32632");
  const MapSquares squares = {Vec2(691'000, 5'335'000), 0.5, 4, 3};
  std::vector<float> height_m;
  for (int k = 0; k < 12; ++k) height_m.push_back(500.0F + 0.25F * static_cast<float>(k));
  height_m[5] = std::numeric_limits<float>::quiet_NaN();
  const auto file = OwnFolder() / "dsm.tif";
  WriteHeights(file, squares, height_m, *map);
  const SurveyRaster read = ReadSurveyRaster(file);
  EXPECT_EQ(read.gaps, 1);
  ASSERT_EQ(read.p_m.size(), 11u);
  EXPECT_EQ(read.p_m[0], Vec3(691'000.25, 5'335'000.25, 500));
  EXPECT_EQ(read.p_m[10], Vec3(691'001.75, 5'335'001.25, 502.75));
  EXPECT_EQ(read.map.name, map->name);
  EXPECT_EQ(read.pixel_m, Vec2(0.5, 0.5));
}

TEST(SurveyRaster, FeetOfAVerticalSystemBecomeMetres) {
  const auto file = OwnFolder() / "navd.tif";
  testing_soil::WriteUtmRaster(file, {{100, 200}, {300, 400}}, 1, {500000, 4'500'000}, GDT_Float32);
  {
    std::unique_ptr<GDALDataset, testing_soil::ReadRaster::Close> dataset(
        static_cast<GDALDataset*>(GDALOpen(file.c_str(), GA_Update)));
    OGRSpatialReference utm_and_feet;  // NAVD88 height (ftUS)
    ASSERT_EQ(utm_and_feet.SetFromUserInput("EPSG:26918+6360"), OGRERR_NONE);
    dataset->SetSpatialRef(&utm_and_feet);
  }
  const SurveyRaster read = ReadSurveyRaster(file);
  EXPECT_NEAR(read.p_m[0].z(), 300 * 1200.0 / 3937, 1e-6);
  EXPECT_THAT(read.map.vertical, HasSubstr("NAVD88"));
}

TEST(SurveyRaster, GapsThatAreNotMarkedAreRefused) {
  const auto map = ReadMapReference("here", "EPSG:32632");
  const auto file = OwnFolder() / "pit.tif";
  WriteHeights(file, {Vec2(691'000, 5'335'000), 0.5, 3, 2},
               {420.0F, -9999.0F, 421.0F, 420.0F, 420.5F, 421.0F}, *map);
  EXPECT_THAT(FaultOf([&] { ReadSurveyRaster(file); }), HasFault(kUnsupported));
}

TEST(SurveyRaster, OfGapsAloneIsRefused) {
  const auto map = ReadMapReference("here", "EPSG:32632");
  const auto file = OwnFolder() / "gaps.tif";
  WriteHeights(file, {Vec2(691'000, 5'335'000), 0.5, 2, 2},
               std::vector<float>(4, std::numeric_limits<float>::quiet_NaN()), *map);
  EXPECT_THAT(FaultOf([&] { ReadSurveyRaster(file); }), HasFault(kMissing));
}

TEST(SurveyRaster, AWrittenTerrainIsASiteWhoseMiddleIsItsOrigin) {
  const SiteOrigin origin{47.2, 9.1, 430};
  const MapSquares squares = {Vec2(-3, -2), 1.0, 6, 4};
  const auto file = OwnFolder() / "terrain.tif";
  WriteHeights(file, squares, std::vector<float>(24, 432.5F), LocalMapReference(origin));
  const ElevationGrid grid = ReadElevation(file);
  EXPECT_NEAR(grid.origin.lat_deg, origin.lat_deg, 1e-9);
  EXPECT_NEAR(grid.origin.lon_deg, origin.lon_deg, 1e-9);
  EXPECT_NEAR(grid.origin.height_m, 432.5, 1e-6);
}

}  // namespace
}  // namespace tera
