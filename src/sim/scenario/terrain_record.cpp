#include "sim/scenario/terrain_record.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/config/plain_name.h"
#include "core/config/spelling.h"

namespace tera {
namespace {

constexpr GroundRaster kAllRasters[] = {GroundRaster::kHeight, GroundRaster::kChange,
                                        GroundRaster::kMassChange, GroundRaster::kDensity,
                                        GroundRaster::kSoilClass};
constexpr GroundRaster kDefaultRasters[] = {GroundRaster::kHeight, GroundRaster::kChange,
                                            GroundRaster::kDensity, GroundRaster::kSoilClass};
/// Largest default raster, in pixels per side; pixel_m allows larger ones.
constexpr int kDefaultPixels = 4001;
constexpr double kMostCubes = 5e6;  ///< cubes in one box, which need 145 MB
constexpr double kShortest_s = 0.01, kLongestInterval_s = 1e6;

/// Converts a length to cells of the site. It must be a whole number of cells.
int CellsIn(const ConfigMap& config, std::string_view key, const TerrainGrid& site,
            double otherwise_m) {
  constexpr double kMost_m = 100, kRounding = 1e-6;
  const double length_m = config.Number(key, Between(site.cell_m, kMost_m, "m"), otherwise_m);
  const double cells = length_m / site.cell_m;
  if (std::abs(cells - std::round(cells)) > kRounding * cells) {
    config.Fault(key, {FaultKind::kOutOfRange,
                       fmt::format("{} m is not a whole multiple of the site's cell of {} m",
                                   length_m, site.cell_m)});
  }
  return std::max(1, static_cast<int>(std::lround(cells)));
}

std::vector<GroundRaster> ReadRasters(const ConfigMap& config) {
  if (!config.Has("terrain")) return {std::begin(kDefaultRasters), std::end(kDefaultRasters)};
  std::vector<std::string> known;
  for (const GroundRaster raster : kAllRasters) known.emplace_back(NameOf(raster));
  std::vector<GroundRaster> rasters;
  for (const std::string& name : config.Texts("terrain")) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
      config.Fault("terrain", {FaultKind::kNoSuchName,
                               fmt::format("'{}' is not a raster of the ground{}; need some of {}",
                                           name, DidYouMean(name, known), fmt::join(known, ", "))});
      continue;
    }
    const GroundRaster raster = kAllRasters[found - known.begin()];
    if (std::find(rasters.begin(), rasters.end(), raster) != rasters.end()) {
      config.Fault("terrain", {FaultKind::kRepeated, fmt::format("names '{}' twice", name)});
    }
    rasters.push_back(raster);
  }
  return rasters;
}

/// Reports a box that is empty, off the site, or has too many cubes.
void CheckBox(const ConfigMap& config, const VoxelBox& box, const TerrainGrid& site) {
  if ((box.high_W_m.array() <= box.low_W_m.array()).any()) {
    config.Fault("high_m", "needs to lie above low_m along x, y and z");
    return;
  }
  const Vec2 site_low_m = site.origin_W_m;
  const Vec2 site_high_m(site.x_m(site.nx - 1), site.y_m(site.ny - 1));
  if ((box.low_W_m.head<2>().array() < site_low_m.array()).any() ||
      (box.high_W_m.head<2>().array() > site_high_m.array()).any()) {
    config.Fault("low_m",
                 {FaultKind::kOutOfRange,
                  fmt::format("the box reaches beyond the site, x {:g} to {:g} m, y {:g} to "
                              "{:g} m",
                              site_low_m.x(), site_high_m.x(), site_low_m.y(), site_high_m.y())});
    return;
  }
  const double edge_m = box.columns * site.cell_m;
  const double cubes = ((box.high_W_m - box.low_W_m) / edge_m).prod();
  if (cubes > kMostCubes) {
    config.Fault("edge_m", {FaultKind::kOutOfRange,
                            fmt::format("{:.3g} cubes of {:g} m are more than the {:g} that a file "
                                        "can have; need a longer edge_m or a smaller box",
                                        cubes, edge_m, kMostCubes)});
  }
}

std::vector<TerrainRecord::Voxels> ReadVoxels(const ConfigMap& config, const TerrainGrid& site) {
  std::vector<TerrainRecord::Voxels> all;
  for (const ConfigMap& item : config.List("voxels")) {
    TerrainRecord::Voxels voxels;
    voxels.name = item.Text("name");
    RequirePlainName(item, "name", voxels.name);
    for (const TerrainRecord::Voxels& other : all) {
      if (other.name == voxels.name)
        item.Fault("name", {FaultKind::kRepeated, "is taken by another box of voxels"});
    }
    voxels.box.low_W_m = item.Vector3("low_m", Any("m"));
    voxels.box.high_W_m = item.Vector3("high_m", Any("m"));
    voxels.box.columns = CellsIn(item, "edge_m", site, site.cell_m);
    CheckBox(item, voxels.box, site);
    all.push_back(voxels);
  }
  return all;
}

}  // namespace

TerrainRecord ReadTerrainRecord(const std::optional<ConfigMap>& config, const TerrainGrid& site) {
  const int side = std::max(site.nx, site.ny);
  const int default_columns = (side - 1) / kDefaultPixels + 1;
  TerrainRecord record;
  record.rasters = {std::begin(kDefaultRasters), std::end(kDefaultRasters)};
  record.columns_per_pixel = default_columns;
  if (!config) return record;
  record.rasters = ReadRasters(*config);
  record.columns_per_pixel = CellsIn(*config, "pixel_m", site, default_columns * site.cell_m);
  if (const auto every_s =
          config->OptionalNumber("every_s", Between(kShortest_s, kLongestInterval_s, "s"))) {
    record.period_ns = std::llround(*every_s * 1e9);
  }
  record.voxels = ReadVoxels(*config, site);
  return record;
}

}  // namespace tera
