#include "soil/site/map_raster.h"

#include <limits>

#include "core/check.h"
#include "soil/site/file_in_place.h"
#include "soil/site/georaster.h"

namespace tera {
namespace {

bool Write(const std::filesystem::path& file, const SiteMap& map, const SiteOrigin& origin) {
  CPLErrorReset();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  CPLStringList options;
  options.AddString("COMPRESS=DEFLATE");
  RasterFile dataset(driver->Create(file.c_str(), map.nx, map.ny, 1, GDT_Float32, options.List()),
                     &GDALClose);
  if (!dataset) return false;
  const OGRSpatialReference projection = SitePlane(origin);
  std::array<double, 6> affine = {
      map.low_W_m.x(), map.square_m, 0, map.low_W_m.y() + map.ny * map.square_m, 0, -map.square_m};
  GDALRasterBand* band = dataset->GetRasterBand(1);
  band->SetDescription(map.description.c_str());
  bool written = dataset->SetSpatialRef(&projection) == CE_None &&
                 dataset->SetGeoTransform(affine.data()) == CE_None &&
                 band->SetUnitType(map.unit.c_str()) == CE_None &&
                 band->SetNoDataValue(std::numeric_limits<double>::quiet_NaN()) == CE_None;
  std::vector<float> row(static_cast<std::size_t>(map.nx));
  for (int j = 0; written && j < map.ny; ++j) {
    // The first row is the northernmost.
    const auto first = map.values.begin() + static_cast<std::ptrdiff_t>(map.ny - 1 - j) * map.nx;
    std::copy(first, first + map.nx, row.begin());
    written = band->RasterIO(GF_Write, 0, j, map.nx, 1, row.data(), map.nx, 1, GDT_Float32, 0, 0) ==
              CE_None;
  }
  dataset.reset();  // what is still in memory is written now
  return written && CPLGetLastErrorType() < CE_Failure;
}

}  // namespace

void WriteSiteMap(const std::filesystem::path& file, const SiteMap& map, const SiteOrigin& origin) {
  TERA_CHECK(map.nx > 0 && map.ny > 0, map.nx, map.ny);
  TERA_CHECK(map.values.size() == static_cast<std::size_t>(map.nx) * map.ny, map.values.size());
  const QuietGdal quiet;
  PutInPlace(file, [&](const std::filesystem::path& part) -> std::optional<std::string> {
    if (Write(part, map, origin)) return std::nullopt;
    return CPLGetLastErrorMsg();
  });
}

}  // namespace tera
