#include "sim/recorded_ground.h"

#include <utility>

#include "soil/site/map_raster.h"

namespace tera {
namespace {

/// Limits a layer to 4 MB, so that a message of a few layers can carry it.
constexpr int kMostSquares = 1024;

}  // namespace

ReadGround ReaderOfGround(const DatasetInfo& info) {
  const SiteOrigin origin{info.origin_lat_deg, info.origin_lon_deg, info.origin_height_m};
  return [origin](const std::filesystem::path& file, const std::string& layer) {
    SiteMap map = layer == "elevation" ? ReadSiteHeights(file, origin, kMostSquares)
                                       : ReadSiteMap(file, origin, kMostSquares);
    return GroundSquares{map.low_W_m, map.square_m, map.nx, map.ny, std::move(map.values)};
  };
}

}  // namespace tera
