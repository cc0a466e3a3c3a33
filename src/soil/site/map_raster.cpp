#include "soil/site/map_raster.h"

#include <limits>

#include "core/check.h"
#include "soil/site/file_in_place.h"
#include "soil/site/write_raster.h"

namespace tera {

void WriteSiteMap(const std::filesystem::path& file, const SiteMap& map, const SiteOrigin& origin) {
  TERA_CHECK(map.nx > 0 && map.ny > 0, map.nx, map.ny);
  TERA_CHECK(map.values.size() == static_cast<std::size_t>(map.nx) * map.ny, map.values.size());
  const QuietGdal quiet;
  const SquareRaster<float> raster{
      map.low_W_m, map.square_m, map.nx,          map.ny,
      map.values,  map.unit,     map.description, std::numeric_limits<double>::quiet_NaN()};
  PutInPlace(file, [&](const std::filesystem::path& part) -> std::optional<std::string> {
    if (WriteSquares(part, raster, SitePlane(origin))) return std::nullopt;
    return CPLGetLastErrorMsg();
  });
}

}  // namespace tera
