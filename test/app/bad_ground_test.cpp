#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/refused.h"
#include "core/faults.h"

// Impossible ground: rasters, soils, layers, regions, and settings of its recording.

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

TEST(BadGround, AGeoTiffThatCannotBeReadIsRefused) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "site.tif", "not a raster");
  const std::string scenario = Edited(SmallScenario(), "size_m: [14, 14]", "geotiff: site.tif");
  ExpectScenarioRefused(scratch, scenario, TellsOf(At(scenario, "site.tif") + "terrain.geotiff"));
}

/// The small scenario on other ground.
std::string OnGround(const std::string& terrain) {
  return Edited(SmallScenario(), "size_m: [14, 14], cell_m: 0.1, soil: dirt", terrain);
}

TEST(BadGround, ASoilThatCannotBeIsRefusedByItsKey) {
  const std::string mine =
      "size_m: [14, 14], soil: mine, custom_soils: [{preset: tera:config/soils/dirt.yaml, name: "
      "mine, KEY}]";
  const std::string light =
      OnGround(Edited(mine, "KEY", "bank_density_kgpm3: -5, max_density_kgpm3: 3000"));
  ExpectScenarioRefused(light,
                        TellsOf(At(light, "-5") + "terrain.custom_soils[0].bank_density_kgpm3"));
  const std::string steep = OnGround(Edited(mine, "KEY", "friction_angle_deg: 90"));
  ExpectScenarioRefused(steep,
                        TellsOf(At(steep, "90}") + "terrain.custom_soils[0].friction_angle_deg"));
}

TEST(BadGround, LayersThatOverlapOrLeaveAGapAreRefused) {
  const std::string layers =
      "size_m: [14, 14], layers: [{soil: dirt, from_m: 0, to_m: 0.4}, {soil: sand, from_m: BELOW}]";
  const std::string overlap = OnGround(Edited(layers, "BELOW", "0.3"));
  ExpectScenarioRefused(overlap, TellsOf(At(overlap, "0.3}") + "terrain.layers[1].from_m"));
  const std::string gap = OnGround(Edited(layers, "BELOW", "0.5"));
  ExpectScenarioRefused(gap, TellsOf(At(gap, "0.5}") + "terrain.layers[1].from_m"));
}

TEST(BadGround, ARegionWithoutAProperOutlineIsRefused) {
  const std::string region =
      "size_m: [14, 14], soil: dirt, regions: [{soil: sand, outline_m: CORNERS}]";
  const std::string crossed =
      OnGround(Edited(region, "CORNERS", "[[0, 0], [2, 2], [2, 0], [0, 2]]"));
  ExpectScenarioRefused(crossed, TellsOf(At(crossed, "[[0, 0]") + "terrain.regions[0].outline_m"));
  const std::string line = OnGround(Edited(region, "CORNERS", "[[0, 0], [2, 2]]"));
  ExpectScenarioRefused(line, TellsOf(At(line, "[[0, 0]") + "terrain.regions[0].outline_m"));
}

/// A raster of 3 x 2 pixels as an ASCII grid, which GDAL reads too.
void WriteAsciiGrid(const fs::path& stem, const std::string& rows, bool projected) {
  WriteWholeFile(stem.string() + ".asc",
                 "ncols 3\nnrows 2\nxllcorner 500000\nyllcorner 4000000\ncellsize 10\n"
                 "NODATA_value -9999\n" +
                     rows);
  if (!projected) return;
  WriteWholeFile(stem.string() + ".prj",
                 "PROJCS[\"UTM 33N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\","
                 "6378137,298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\","
                 "0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
                 "PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",15],"
                 "PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],"
                 "PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]");
}

TEST(BadGround, HeightsWithGapsOrWithoutAProjectionAreRefused) {
  const ScratchDirectory scratch;
  WriteAsciiGrid(scratch.path() / "gaps", "1 2 -9999\n4 5 6\n", true);
  const std::string gaps = OnGround("geotiff: gaps.asc");
  ExpectScenarioRefused(scratch, gaps, TellsOf(At(gaps, "gaps.asc") + "terrain.geotiff"));
  WriteAsciiGrid(scratch.path() / "plain", "1 2 3\n4 5 6\n", false);
  ExpectScenarioRefused(scratch, OnGround("geotiff: plain.asc"), TellsOf("terrain.geotiff"));
}

TEST(BadGround, SoilClassesOfAnotherTypeAreRefused) {
  const ScratchDirectory scratch;
  WriteAsciiGrid(scratch.path() / "soil", "1 1 2\n1 2 2\n", true);
  const std::string scenario =
      OnGround("soil_classes: {geotiff: soil.asc, classes: [{value: 1, soil: sand}]}");
  ExpectScenarioRefused(scratch, scenario,
                        TellsOf(At(scenario, "soil.asc") + "terrain.soil_classes.geotiff"));
}

TEST(BadGround, WhatCannotBeRecordedOfTheGroundIsRefused) {
  const auto refused = [](const std::string& record, const std::string& place,
                          const std::string& message) {
    const std::string scenario = SmallScenario() + "record: " + record + "\n";
    ExpectScenarioRefused(scenario, AllOf(StartsWith(At(scenario, place)), HasSubstr(message)));
  };
  refused("{terrain: [hight]}", "[hight]", "not a raster of the ground (did you mean 'height'?)");
  refused("{terrain: [height, height]}", "[height", "names 'height' twice");
  refused("{pixel_m: 0.25}", "0.25", "not a whole multiple of the site's cell of 0.1 m");
  refused("{every_s: 0}", "0}\n", "every_s: 0 is out of range");
  const std::string box = "{voxels: [{name: pit, low_m: [-1, -1, -1], high_m: HIGH}]}";
  refused(Edited(box, "HIGH", "[1, 1, -2]"), "[1, 1, -2]", "needs to lie above low_m");
  refused(Edited(box, "HIGH", "[9, 1, 1]"), "[-1, -1", "reaches beyond the site, x -7 to 7 m");
  refused(Edited(box, "HIGH", "[1, 1, 2e5]"), "{name: pit", "are more than the 5e+06");
}

}  // namespace
}  // namespace tera
