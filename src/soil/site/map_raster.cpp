#include "soil/site/map_raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "soil/site/file_in_place.h"
#include "soil/site/write_raster.h"

namespace tera {
namespace {

struct Squares {
  SiteMap map;     ///< without values
  int pixels = 1;  ///< pixels along the side of a square
};

/// Refuses a raster in another projection than that of the site.
void RequireSitePlane(const std::filesystem::path& file, GDALDataset* raster,
                      const std::array<double, 6>& affine, const SiteOrigin& origin) {
  constexpr double kSame_m = 0.001;
  OGRSpatialReference projection = *raster->GetSpatialRef();
  projection.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::vector<double> x_m = {affine[0], affine[0] + affine[1] * raster->GetRasterXSize()};
  const std::vector<double> y_m = {affine[3], affine[3] + affine[5] * raster->GetRasterYSize()};
  std::vector<double> x = x_m, y = y_m;
  Conversion(file, projection, SitePlane(origin)).Apply(&x, &y);
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (std::hypot(x[k] - x_m[k], y[k] - y_m[k]) <= kSame_m) continue;
    Refuse(file, {FaultKind::kInconsistent,
                  "is in another projection than its recording's origin says; need the file that "
                  "was recorded"});
  }
}

Squares SquaresOf(const std::filesystem::path& file, GDALDataset* raster, const SiteOrigin& origin,
                  int most_side) {
  std::array<double, 6> affine{};
  const bool placed =
      raster->GetSpatialRef() != nullptr && raster->GetGeoTransform(affine.data()) == CE_None;
  if (!placed || affine[2] != 0 || affine[4] != 0 || affine[1] <= 0 || affine[5] != -affine[1]) {
    Refuse(file, {FaultKind::kMissing,
                  "has no projection, is not north-up, or its pixels are no squares; need the file "
                  "that was recorded"});
  }
  RequireSitePlane(file, raster, affine, origin);
  const int nx = raster->GetRasterXSize(), ny = raster->GetRasterYSize();
  Squares squares;
  squares.pixels = (std::max(nx, ny) + most_side - 1) / most_side;
  squares.map.square_m = affine[1] * squares.pixels;
  squares.map.nx = nx / squares.pixels;
  squares.map.ny = ny / squares.pixels;
  if (squares.map.nx < 1 || squares.map.ny < 1) {
    Refuse(file, {FaultKind::kOutOfRange,
                  fmt::format("{} x {} pixels found, need a site that is less narrow", nx, ny)});
  }
  squares.map.low_W_m = Vec2(affine[0], affine[3] - squares.map.ny * squares.map.square_m);
  return squares;
}

}  // namespace

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

SiteMap ReadSiteMap(const std::filesystem::path& file, const SiteOrigin& origin, int most_side) {
  const QuietGdal quiet;
  const RasterFile raster = OpenRaster(file, "raster of a recording's ground");
  const Squares squares = SquaresOf(file, raster.get(), origin, most_side);
  GDALRasterBand* band = raster->GetRasterBand(1);
  SiteMap map = squares.map;
  map.unit = band->GetUnitType();
  map.description = band->GetDescription();
  map.values.resize(static_cast<std::size_t>(map.nx) * map.ny);
  GDALRasterIOExtraArg how;
  INIT_RASTERIO_EXTRA_ARG(how);
  how.eResampleAlg = band->GetRasterDataType() == GDT_Byte ? GRIORA_Mode : GRIORA_Average;
  // The first row of the file is the northernmost one, so the rows are stored backwards.
  const std::size_t last_row = static_cast<std::size_t>(map.ny - 1) * map.nx;
  const GSpacing line = -static_cast<GSpacing>(map.nx) * static_cast<GSpacing>(sizeof(float));
  if (band->RasterIO(GF_Read, 0, 0, map.nx * squares.pixels, map.ny * squares.pixels,
                     map.values.data() + last_row, map.nx, map.ny, GDT_Float32, sizeof(float), line,
                     &how) != CE_None) {
    Refuse(file, {FaultKind::kMalformed,
                  fmt::format("its pixels cannot be read ({}); the file may be truncated",
                              CPLGetLastErrorMsg())});
  }
  const BandScaling scaling(band);
  for (float& value : map.values) value = static_cast<float>(scaling.Value(value));
  return map;
}

SiteMap ReadSiteHeights(const std::filesystem::path& file, const SiteOrigin& origin,
                        int most_side) {
  SiteMap map = ReadSiteMap(file, origin, most_side);
  const EllipsoidDrop drop(origin.lat_deg);
  for (int j = 0; j < map.ny; ++j) {
    const double y_m = map.low_W_m.y() + (j + 0.5) * map.square_m;
    for (int i = 0; i < map.nx; ++i) {
      const double x_m = map.low_W_m.x() + (i + 0.5) * map.square_m;
      float& value = map.values[static_cast<std::size_t>(j) * map.nx + i];
      value = static_cast<float>(value - origin.height_m - drop.At_m(x_m, y_m));
    }
  }
  return map;
}

}  // namespace tera
