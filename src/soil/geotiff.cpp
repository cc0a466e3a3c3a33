#include "soil/geotiff.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/units.h"

namespace tera {
namespace {

using Dataset = std::unique_ptr<GDALDataset, decltype(&GDALClose)>;
using Transformation =
    std::unique_ptr<OGRCoordinateTransformation, decltype(&OGRCoordinateTransformation::DestroyCT)>;

/// GDAL's drivers, registered once, with its messages kept for our own.
void PrepareGdal() {
  static const bool ready = [] {
    GDALAllRegister();
    return true;
  }();
  (void)ready;
}

class QuietGdal {
 public:
  QuietGdal() { CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~QuietGdal() { CPLPopErrorHandler(); }
};

[[noreturn]] void Refuse(const std::filesystem::path& file, const std::string& finding) {
  throw InputError(fmt::format("{}: {}", file.string(), finding));
}

/// Metres of a degree of latitude and longitude at `lat_deg` on WGS 84.
Vec2 MetresPerDegree(double lat_deg) {
  constexpr double kSemiMajor_m = 6378137.0, kFlattening = 1 / 298.257223563;
  constexpr double kE2 = kFlattening * (2 - kFlattening);
  const double s = std::sin(lat_deg * kDeg);
  const double w = 1 - kE2 * s * s;
  const double meridian_m = kSemiMajor_m * (1 - kE2) / (w * std::sqrt(w));
  const double normal_m = kSemiMajor_m / std::sqrt(w);
  return Vec2(normal_m * std::cos(lat_deg * kDeg) * kDeg, meridian_m * kDeg);
}

}  // namespace

double ElevationGrid::HeightAt(double x_m, double y_m) const {
  const double gx = std::clamp((x_m + 0.5 * width_m()) / cell_x_m, 0.0, nx - 1.0);
  const double gy = std::clamp((y_m + 0.5 * depth_m()) / cell_y_m, 0.0, ny - 1.0);
  const int i = std::min(static_cast<int>(gx), nx - 2), j = std::min(static_cast<int>(gy), ny - 2);
  const double u = gx - i, v = gy - j;
  const double* row = &height_m[static_cast<std::size_t>(j) * nx + i];
  return (1 - v) * ((1 - u) * row[0] + u * row[1]) + v * ((1 - u) * row[nx] + u * row[nx + 1]);
}

ElevationGrid ReadElevation(const std::filesystem::path& file) {
  PrepareGdal();
  const QuietGdal quiet;
  const Dataset dataset(static_cast<GDALDataset*>(GDALOpen(file.c_str(), GA_ReadOnly)), &GDALClose);
  if (!dataset) {
    Refuse(file, fmt::format("not readable as a GeoTIFF ({}); give a one-band elevation raster",
                             CPLGetLastErrorMsg()));
  }
  if (dataset->GetRasterCount() != 1) {
    Refuse(file, fmt::format("{} bands found, need one band of heights in metres",
                             dataset->GetRasterCount()));
  }
  const OGRSpatialReference* projection = dataset->GetSpatialRef();
  std::array<double, 6> affine{};
  if (!projection || dataset->GetGeoTransform(affine.data()) != CE_None) {
    Refuse(file,
           "has no projection or no geotransform; add them with gdal_translate -a_srs "
           "and -a_ullr");
  }
  if (affine[2] != 0 || affine[4] != 0 || affine[1] <= 0 || affine[5] >= 0) {
    Refuse(file, "is rotated or not north-up; warp it with gdalwarp first");
  }
  ElevationGrid grid;
  grid.nx = dataset->GetRasterXSize();
  grid.ny = dataset->GetRasterYSize();
  if (grid.nx < 2 || grid.ny < 2) {
    Refuse(file, fmt::format("{} x {} pixels found, need at least 2 x 2", grid.nx, grid.ny));
  }
  std::vector<double> rows(static_cast<std::size_t>(grid.nx) * grid.ny);
  GDALRasterBand* band = dataset->GetRasterBand(1);
  if (band->RasterIO(GF_Read, 0, 0, grid.nx, grid.ny, rows.data(), grid.nx, grid.ny, GDT_Float64, 0,
                     0) != CE_None) {
    Refuse(file, fmt::format("its pixels cannot be read ({}); the file may be truncated",
                             CPLGetLastErrorMsg()));
  }
  int has_gap_value = 0;
  const double gap_value = band->GetNoDataValue(&has_gap_value);
  const auto gaps = std::count_if(rows.begin(), rows.end(), [&](double z) {
    return !std::isfinite(z) || (has_gap_value && z == gap_value);
  });
  if (gaps > 0) {
    Refuse(file, fmt::format("{} of {} pixels have no height; fill the gaps, e.g. with "
                             "gdal_fillnodata.py",
                             gaps, rows.size()));
  }
  // Middle of the raster to WGS 84.
  OGRSpatialReference wgs84;
  wgs84.SetWellKnownGeogCS("WGS84");
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  OGRSpatialReference from(*projection);
  from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const Transformation to_wgs84(OGRCreateCoordinateTransformation(&from, &wgs84),
                                &OGRCoordinateTransformation::DestroyCT);
  double x = affine[0] + 0.5 * grid.nx * affine[1], y = affine[3] + 0.5 * grid.ny * affine[5];
  if (!to_wgs84 || !to_wgs84->Transform(1, &x, &y)) {
    Refuse(file, "its reference system cannot be converted to WGS 84; reproject it with gdalwarp");
  }
  grid.origin = {y, x, 0};
  const Vec2 unit_m =
      from.IsGeographic() ? MetresPerDegree(y) : Vec2::Constant(from.GetLinearUnits());
  grid.cell_x_m = affine[1] * unit_m.x();
  grid.cell_y_m = -affine[5] * unit_m.y();
  grid.height_m.resize(rows.size());
  for (int j = 0; j < grid.ny; ++j) {  // the file's first row is the northernmost
    std::copy_n(&rows[static_cast<std::size_t>(grid.ny - 1 - j) * grid.nx], grid.nx,
                &grid.height_m[static_cast<std::size_t>(j) * grid.nx]);
  }
  grid.origin.height_m = grid.HeightAt(0, 0);
  for (double& z : grid.height_m) z -= grid.origin.height_m;
  return grid;
}

void WriteElevation(const std::filesystem::path& file, const TerrainSurface& surface,
                    const SiteOrigin& origin) {
  PrepareGdal();
  const QuietGdal quiet;
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  char** options = CSLSetNameValue(nullptr, "COMPRESS", "DEFLATE");
  const Dataset dataset(
      driver->Create(file.c_str(), surface.nx, surface.ny, 1, GDT_Float32, options), &GDALClose);
  CSLDestroy(options);
  if (!dataset) {
    Refuse(file, fmt::format("cannot be written ({}); check the folder and its permissions",
                             CPLGetLastErrorMsg()));
  }
  OGRSpatialReference projection;
  projection.SetProjCS("Site plane");
  projection.SetWellKnownGeogCS("WGS84");
  projection.SetTM(origin.lat_deg, origin.lon_deg, 1.0, 0.0, 0.0);
  projection.SetLinearUnits(SRS_UL_METER, 1.0);
  // Pixels are centred on the vertices; the first row is the northernmost.
  const double h = surface.cell_m;
  std::array<double, 6> affine = {surface.origin_W_m.x() - 0.5 * h,
                                  h,
                                  0,
                                  surface.origin_W_m.y() + (surface.ny - 0.5) * h,
                                  0,
                                  -h};
  std::vector<float> rows(surface.height_m.size());
  for (int j = 0; j < surface.ny; ++j) {
    for (int i = 0; i < surface.nx; ++i) {
      rows[static_cast<std::size_t>(surface.ny - 1 - j) * surface.nx + i] =
          surface.height_m[surface.index(i, j)] + static_cast<float>(origin.height_m);
    }
  }
  const bool written =
      dataset->SetSpatialRef(&projection) == CE_None &&
      dataset->SetGeoTransform(affine.data()) == CE_None &&
      dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, surface.nx, surface.ny, rows.data(),
                                          surface.nx, surface.ny, GDT_Float32, 0, 0) == CE_None;
  dataset->FlushCache();
  if (!written || CPLGetLastErrorType() >= CE_Failure) {
    Refuse(file, fmt::format("cannot be written ({}); is the disk full?", CPLGetLastErrorMsg()));
  }
}

}  // namespace tera
