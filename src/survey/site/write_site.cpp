#include "survey/site/write_site.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "soil/site/geotiff.h"
#include "soil/site/survey_raster.h"
#include "survey/site/free_place.h"

namespace tera {
namespace {

constexpr std::array<const char*, 4> kSourceNames = {"measured", "filled", "under_things",
                                                     "beyond_survey"};

std::string NameOf(std::size_t thing) { return fmt::format("thing_{:03}", thing + 1); }

/// Size of a thing's box, and height of its centre above the ground at the centre of the footprint.
struct ThingBox {
  Vec3 size_m;
  double middle_m;
};

ThingBox BoxOf(const SurveyThing& thing) {
  return {Vec3(thing.footprint.length_m, thing.footprint.width_m, thing.top_m - thing.foot_m),
          0.5 * (thing.foot_m + thing.top_m) - thing.ground_m};
}

/// Wavefront OBJ text of a box in the obstacle's frame, z up.
std::string BoxMesh(const ThingBox& box) {
  std::string text =
      "# Box of a thing that was surveyed; x along its longer side, z up, metres.\n"
      "o body\n";
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 sign(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
    const Vec3 at = sign.cwiseProduct(box.size_m) + Vec3(0, 0, box.middle_m);
    text += fmt::format("v {:.4f} {:.4f} {:.4f}\n", at.x(), at.y(), at.z());
  }
  // Faces are counterclockwise seen from outside, each with its normal: bottom, top and four sides.
  return text +
         "vn 0 0 -1\nvn 0 0 1\nvn 0 -1 0\nvn 1 0 0\nvn 0 1 0\nvn -1 0 0\n"
         "f 1//1 3//1 4//1 2//1\nf 5//2 6//2 8//2 7//2\nf 1//3 2//3 6//3 5//3\n"
         "f 2//4 4//4 8//4 6//4\nf 4//5 3//5 7//5 8//5\nf 3//6 1//6 5//6 7//6\n";
}

/// Converts site coordinates to the world frame W.
struct InW {
  Vec2 xy_m;
  double yaw_rad;
};

InW PlaceInW(const SurveySite& site, const SiteOrigin& origin, const Vec2& place_m,
             double yaw_rad) {
  const Vec2 ahead_m = place_m + Vec2(std::cos(yaw_rad), std::sin(yaw_rad));
  const auto in_W = PlacesInW(site.map, origin, {place_m, ahead_m});
  const Vec2 along = in_W[1] - in_W[0];
  return {in_W[0], std::atan2(along.y(), along.x())};
}

/// Spacing of the scenario's soil columns: 5 cm, which resolves tracks, or more for a large site.
double ColumnSpacing_m(const SurveyTerrain& terrain) {
  constexpr double kMostColumns = 4e6;
  const double area_m2 =
      terrain.grid.cell_m * terrain.grid.cell_m * static_cast<double>(terrain.grid.size());
  for (const double spacing_m : {0.05, 0.1, 0.25, 0.5}) {
    if (area_m2 <= kMostColumns * spacing_m * spacing_m) return spacing_m;
  }
  return 1.0;
}

std::string Machines(const SurveySite& site, const SiteOrigin& origin) {
  std::string text = "machines:\n";
  if (const auto place_m = FindFreePlace(site, PlaceNeed())) {
    const InW at = PlaceInW(site, origin, *place_m, 0);
    text += fmt::format(
        "  - name: excavator1      # where the ground is level and free\n"
        "    machine: tera:config/machines/tb235.yaml\n"
        "    start: {{xy_m: [{:.2f}, {:.2f}], joints_deg: {{boom: 40, arm: -95, bucket: -20}}}}\n"
        "    operator: {{type: idle}}\n",
        at.xy_m.x(), at.xy_m.y());
  }
  const Vec2 overlook_m = FindOverlook(site);
  const CellGrid& grid = site.terrain.grid;
  const Vec2 to_middle = grid.low_m + 0.5 * grid.cell_m * Vec2(grid.nx, grid.ny) - overlook_m;
  const InW at = PlaceInW(site, origin, overlook_m, std::atan2(to_middle.y(), to_middle.x()));
  text += fmt::format(
      "  - name: mast1\n"
      "    machine: tera:config/machines/mast.yaml\n"
      "    start: {{xy_m: [{:.2f}, {:.2f}], yaw_deg: {:.1f}}}\n"
      "    operator: {{type: idle}}\n"
      "    rig: tera:config/rigs/mast.yaml\n",
      at.xy_m.x(), at.xy_m.y(), at.yaw_rad / kDeg);
  return text;
}

std::string Obstacles(const SurveySite& site, const SiteOrigin& origin) {
  std::string text;
  for (std::size_t k = 0; k < site.things.size(); ++k) {
    const SurveyThing& thing = site.things[k];
    const ThingBox box = BoxOf(thing);
    const InW at = PlaceInW(site, origin, thing.footprint.middle_m, thing.footprint.yaw_rad);
    text += fmt::format(
        "  - name: {0}\n"
        "    label: structure        # open: vehicle, person, vegetation, ...\n"
        "    mesh: things/{0}.obj\n"
        "    xy_m: [{1:.3f}, {2:.3f}]\n"
        "    yaw_deg: {3:.2f}\n"
        "    collision: [{{xyz_m: [0, 0, {4:.3f}], size_m: [{5:.3f}, {6:.3f}, {7:.3f}]}}]\n",
        NameOf(k), at.xy_m.x(), at.xy_m.y(), at.yaw_rad / kDeg, box.middle_m, box.size_m.x(),
        box.size_m.y(), box.size_m.z());
  }
  return text.empty() ? "" : "obstacles:\n" + text;
}

std::string ScenarioText(const SurveySite& site, const std::string& name, const std::string& source,
                         const SiteOrigin& origin) {
  return fmt::format(
      "# The site of {}, made by tera site. W is about the middle of terrain.tif.\n"
      "name: {}\n"
      "seed: 1\n"
      "duration_s: 1\n"
      "terrain: {{geotiff: terrain.tif, cell_m: {}, soil: dirt}}\n{}{}",
      source, name, ColumnSpacing_m(site.terrain), Machines(site, origin), Obstacles(site, origin));
}

std::string ReportText(const SurveySite& site, const std::string& source,
                       const SiteOrigin& origin) {
  nlohmann::ordered_json report;
  report["survey"] = source;
  report["map"] = site.has_map ? site.map.name : "";
  if (!site.middle_m.isZero()) report["middle_m"] = {site.middle_m.x(), site.middle_m.y()};
  report["heights_above"] = site.map.vertical;
  report["origin"] = {
      {"lat_deg", origin.lat_deg}, {"lon_deg", origin.lon_deg}, {"height_m", origin.height_m}};
  report["points"] = {{"read", site.points},
                      {"left_out", site.left_out},
                      {"outliers", site.outliers},
                      {"ground", site.ground_points}};
  report["terrain"] = {{"cell_m", site.terrain.grid.cell_m},
                       {"columns", site.terrain.grid.nx},
                       {"rows", site.terrain.grid.ny}};
  for (std::size_t k = 0; k < kSourceNames.size(); ++k) {
    report["terrain"][kSourceNames[k]] = site.terrain.CountOf(static_cast<HeightSource>(k));
  }
  report["things"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < site.things.size(); ++k) {
    const SurveyThing& thing = site.things[k];
    const InW at = PlaceInW(site, origin, thing.footprint.middle_m, thing.footprint.yaw_rad);
    report["things"].push_back({{"name", NameOf(k)},
                                {"xy_W_m", {at.xy_m.x(), at.xy_m.y()}},
                                {"yaw_deg", at.yaw_rad / kDeg},
                                {"length_m", thing.footprint.length_m},
                                {"width_m", thing.footprint.width_m},
                                {"height_m", thing.top_m - thing.ground_m},
                                {"points", thing.points}});
  }
  return report.dump(2) + "\n";
}

}  // namespace

void WriteSite(const SurveySite& site, const std::string& name, const std::string& source,
               const std::filesystem::path& folder) {
  const SurveyTerrain& terrain = site.terrain;
  const MapSquares squares = {terrain.grid.low_m, terrain.grid.cell_m, terrain.grid.nx,
                              terrain.grid.ny};
  WriteHeights(folder / "terrain.tif", squares, terrain.height_m, site.map);
  std::vector<std::uint8_t> mask;
  for (const HeightSource source_of : terrain.source) {
    mask.push_back(static_cast<std::uint8_t>(source_of));
  }
  WriteClasses(folder / "mask.tif", squares, mask,
               "0 measured, 1 filled, 2 under a thing, 3 beyond the survey", site.map);
  // A scenario uses the centre of the raster as the origin of W.
  const SiteOrigin origin = ReadElevation(folder / "terrain.tif").origin;
  if (!site.things.empty()) MakeFolder(folder / "things");
  for (std::size_t k = 0; k < site.things.size(); ++k) {
    WriteWholeFile(folder / "things" / (NameOf(k) + ".obj"), BoxMesh(BoxOf(site.things[k])));
  }
  WriteWholeFile(folder / "site.yaml", ScenarioText(site, name, source, origin));
  WriteWholeFile(folder / "site.json", ReportText(site, source, origin));
}

}  // namespace tera
