#include "diagnose/report/files/ground_map_file.h"

#include <algorithm>
#include <limits>

#include "soil/site/map_raster.h"

namespace tera {
namespace {

SiteMap AsSiteMap(const GroundMap& ground) {
  auto [low_i, low_j] = ground.cells.begin()->first;
  int high_i = low_i, high_j = low_j;
  for (const auto& [place, cell] : ground.cells) {
    low_i = std::min(low_i, place.first);
    high_i = std::max(high_i, place.first);
    low_j = std::min(low_j, place.second);
    high_j = std::max(high_j, place.second);
  }
  SiteMap map;
  map.low_W_m = ground.cell_m * Vec2(low_i, low_j);
  map.square_m = ground.cell_m;
  map.nx = high_i - low_i + 1;
  map.ny = high_j - low_j + 1;
  map.unit = "m";
  map.description = "measured ground over simulated ground";
  map.values.assign(static_cast<std::size_t>(map.nx) * map.ny,
                    std::numeric_limits<float>::quiet_NaN());
  for (const auto& [place, cell] : ground.cells) {
    const auto row = static_cast<std::size_t>(place.second - low_j);
    map.values[row * map.nx + (place.first - low_i)] = static_cast<float>(cell.above_m);
  }
  return map;
}

}  // namespace

void WriteGroundMaps(const std::filesystem::path& directory, const Diagnosis& diagnosis) {
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    if (sensor.ground.cells.empty()) continue;
    WriteSiteMap(directory / ("ground_" + sensor.target + ".tif"), AsSiteMap(sensor.ground),
                 diagnosis.origin);
  }
}

}  // namespace tera
