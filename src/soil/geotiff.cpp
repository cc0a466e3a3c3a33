#include "soil/geotiff.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

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

/// How far the ellipsoid falls below its tangent plane at latitude `lat_deg`, east and north of the
/// point of contact: the parabola of the two main curvatures of WGS 84.
class EllipsoidDrop {
 public:
  explicit EllipsoidDrop(double lat_deg) {
    constexpr double kSemiMajor_m = 6378137.0, kFlattening = 1 / 298.257223563;
    constexpr double kE2 = kFlattening * (2 - kFlattening);
    const double s = std::sin(lat_deg * kDeg);
    const double w = 1 - kE2 * s * s;
    normal_m_ = kSemiMajor_m / std::sqrt(w);
    meridian_m_ = kSemiMajor_m * (1 - kE2) / (w * std::sqrt(w));
  }
  double At_m(double x_m, double y_m) const {
    return 0.5 * (x_m * x_m / normal_m_ + y_m * y_m / meridian_m_);
  }

 private:
  double normal_m_ = 0, meridian_m_ = 0;
};

/// Transverse Mercator about `origin`, whose axes are east and north there.
OGRSpatialReference SitePlane(const SiteOrigin& origin) {
  OGRSpatialReference plane;
  plane.SetProjCS("Site plane");
  plane.SetWellKnownGeogCS("WGS84");
  plane.SetTM(origin.lat_deg, origin.lon_deg, 1.0, 0.0, 0.0);
  plane.SetLinearUnits(SRS_UL_METER, 1.0);
  return plane;
}

/// Heights as they stand in a file, rows from the south.
struct Raster {
  int nx = 0, ny = 0;
  std::vector<double> height_m;
  std::array<double, 6> affine{};  ///< GDAL's geotransform
  OGRSpatialReference projection;

  /// Place of the pixel (i, j)'s centre, j counted from the south.
  Vec2 PlaceOf(double i, double j) const {
    return {affine[0] + (i + 0.5) * affine[1], affine[3] + (ny - 0.5 - j) * affine[5]};
  }
  /// Bilinear height at a place; that of the nearest border outside.
  double HeightAt(const Vec2& place) const {
    const double gx = std::clamp((place.x() - affine[0]) / affine[1] - 0.5, 0.0, nx - 1.0);
    const double gy = std::clamp(ny - 0.5 - (place.y() - affine[3]) / affine[5], 0.0, ny - 1.0);
    const int i = std::min(static_cast<int>(gx), nx - 2);
    const int j = std::min(static_cast<int>(gy), ny - 2);
    const double u = gx - i, v = gy - j;
    const double* row = &height_m[static_cast<std::size_t>(j) * nx + i];
    return (1 - v) * ((1 - u) * row[0] + u * row[1]) + v * ((1 - u) * row[nx] + u * row[nx + 1]);
  }
};

Dataset Open(const std::filesystem::path& file) {
  Dataset dataset(static_cast<GDALDataset*>(GDALOpen(file.c_str(), GA_ReadOnly)), &GDALClose);
  if (!dataset) {
    Refuse(file, fmt::format("not readable as a GeoTIFF ({}); give a one-band elevation raster",
                             CPLGetLastErrorMsg()));
  }
  if (dataset->GetRasterCount() != 1) {
    Refuse(file, fmt::format("{} bands found, need one band of heights in metres",
                             dataset->GetRasterCount()));
  }
  return dataset;
}

/// Projection, geotransform and size of a file, checked.
Raster ReadFrame(const std::filesystem::path& file, GDALDataset* dataset) {
  Raster raster;
  const OGRSpatialReference* projection = dataset->GetSpatialRef();
  if (!projection || dataset->GetGeoTransform(raster.affine.data()) != CE_None) {
    Refuse(file,
           "has no projection or no geotransform; add them with gdal_translate -a_srs "
           "and -a_ullr");
  }
  const std::array<double, 6>& affine = raster.affine;
  if (affine[2] != 0 || affine[4] != 0 || affine[1] <= 0 || affine[5] >= 0) {
    Refuse(file, "is rotated or not north-up; warp it with gdalwarp first");
  }
  raster.nx = dataset->GetRasterXSize();
  raster.ny = dataset->GetRasterYSize();
  if (raster.nx < 2 || raster.ny < 2) {
    Refuse(file, fmt::format("{} x {} pixels found, need at least 2 x 2", raster.nx, raster.ny));
  }
  raster.projection = *projection;
  raster.projection.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return raster;
}

void ReadHeights(const std::filesystem::path& file, GDALDataset* dataset, Raster* raster) {
  const int nx = raster->nx, ny = raster->ny;
  std::vector<double> rows(static_cast<std::size_t>(nx) * ny);
  GDALRasterBand* band = dataset->GetRasterBand(1);
  const std::string unit = band->GetUnitType();
  if (!unit.empty() && unit != "m" && unit != "metre" && unit != "meter") {
    Refuse(file, fmt::format("its heights are in '{}', need metres; convert them with gdal_calc.py",
                             unit));
  }
  if (band->RasterIO(GF_Read, 0, 0, nx, ny, rows.data(), nx, ny, GDT_Float64, 0, 0) != CE_None) {
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
  raster->height_m.resize(rows.size());
  for (int j = 0; j < ny; ++j) {  // the file's first row is the northernmost
    std::copy_n(&rows[static_cast<std::size_t>(ny - 1 - j) * nx], nx,
                &raster->height_m[static_cast<std::size_t>(j) * nx]);
  }
}

/// Moves places from one reference system to another, or refuses the file.
void Convert(const std::filesystem::path& file, const OGRSpatialReference& from,
             const OGRSpatialReference& to, std::vector<double>* x, std::vector<double>* y) {
  const Transformation transformation(OGRCreateCoordinateTransformation(&from, &to),
                                      &OGRCoordinateTransformation::DestroyCT);
  if (!transformation ||
      !transformation->Transform(static_cast<int>(x->size()), x->data(), y->data())) {
    Refuse(file, "its reference system cannot be converted to WGS 84; reproject it with gdalwarp");
  }
}

/// Geodetic place of the raster's middle.
SiteOrigin MiddleOf(const std::filesystem::path& file, const Raster& raster) {
  OGRSpatialReference wgs84;
  wgs84.SetWellKnownGeogCS("WGS84");
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const Vec2 middle = raster.PlaceOf(0.5 * (raster.nx - 1), 0.5 * (raster.ny - 1));
  std::vector<double> lon_deg = {middle.x()}, lat_deg = {middle.y()};
  Convert(file, raster.projection, wgs84, &lon_deg, &lat_deg);
  return {lat_deg[0], lon_deg[0], raster.HeightAt(middle)};
}

/// Spacing of the raster's pixels about its middle, in the site's plane.
Vec2 CellSize(const std::filesystem::path& file, const Raster& raster,
              const OGRSpatialReference& plane) {
  const double i = 0.5 * (raster.nx - 1), j = 0.5 * (raster.ny - 1);
  std::vector<double> x, y;
  for (const Vec2& place : {raster.PlaceOf(i - 0.5, j), raster.PlaceOf(i + 0.5, j),
                            raster.PlaceOf(i, j - 0.5), raster.PlaceOf(i, j + 0.5)}) {
    x.push_back(place.x());
    y.push_back(place.y());
  }
  Convert(file, raster.projection, plane, &x, &y);
  return {std::hypot(x[1] - x[0], y[1] - y[0]), std::hypot(x[3] - x[2], y[3] - y[2])};
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
  const Dataset dataset = Open(file);
  Raster raster = ReadFrame(file, dataset.get());
  ReadHeights(file, dataset.get(), &raster);

  ElevationGrid grid;
  grid.nx = raster.nx;
  grid.ny = raster.ny;
  grid.origin = MiddleOf(file, raster);
  const OGRSpatialReference plane = SitePlane(grid.origin);
  const Vec2 cell_m = CellSize(file, raster, plane);
  grid.cell_x_m = cell_m.x();
  grid.cell_y_m = cell_m.y();
  std::vector<double> x, y;
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      x.push_back(i * grid.cell_x_m - 0.5 * grid.width_m());
      y.push_back(j * grid.cell_y_m - 0.5 * grid.depth_m());
    }
  }
  const std::vector<double> east_m = x, north_m = y;
  Convert(file, plane, raster.projection, &x, &y);
  const EllipsoidDrop drop(grid.origin.lat_deg);
  for (std::size_t k = 0; k < x.size(); ++k) {
    grid.height_m.push_back(raster.HeightAt(Vec2(x[k], y[k])) - grid.origin.height_m -
                            drop.At_m(east_m[k], north_m[k]));
  }
  return grid;
}

namespace {

/// The surface in the file's order, as heights above the ellipsoid.
std::vector<float> RowsFromNorth(const TerrainSurface& surface, const SiteOrigin& origin) {
  const EllipsoidDrop drop(origin.lat_deg);
  std::vector<float> rows(static_cast<std::size_t>(surface.nx) * surface.ny);
  for (int j = 0; j < surface.ny; ++j) {
    for (int i = 0; i < surface.nx; ++i) {
      rows[static_cast<std::size_t>(surface.ny - 1 - j) * surface.nx + i] = static_cast<float>(
          surface.height_m(i, j) + origin.height_m + drop.At_m(surface.x_m(i), surface.y_m(j)));
    }
  }
  return rows;
}

/// Writes and closes `file`; true if GDAL reports no error from the opening to the closing.
bool WriteRaster(const std::filesystem::path& file, const TerrainSurface& surface,
                 const SiteOrigin& origin) {
  CPLErrorReset();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  char** options = CSLSetNameValue(nullptr, "COMPRESS", "DEFLATE");
  Dataset dataset(driver->Create(file.c_str(), surface.nx, surface.ny, 1, GDT_Float32, options),
                  &GDALClose);
  CSLDestroy(options);
  if (!dataset) return false;
  const OGRSpatialReference projection = SitePlane(origin);
  // Pixels are centred on the vertices; the first row is the northernmost.
  const double h = surface.cell_m;
  std::array<double, 6> affine = {surface.origin_W_m.x() - 0.5 * h,
                                  h,
                                  0,
                                  surface.origin_W_m.y() + (surface.ny - 0.5) * h,
                                  0,
                                  -h};
  std::vector<float> rows = RowsFromNorth(surface, origin);
  const bool written =
      dataset->SetSpatialRef(&projection) == CE_None &&
      dataset->SetGeoTransform(affine.data()) == CE_None &&
      dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, surface.nx, surface.ny, rows.data(),
                                          surface.nx, surface.ny, GDT_Float32, 0, 0) == CE_None;
  dataset.reset();  // what is still in memory is written now
  return written && CPLGetLastErrorType() < CE_Failure;
}

}  // namespace

void WriteElevation(const std::filesystem::path& file, const TerrainSurface& surface,
                    const SiteOrigin& origin) {
  PrepareGdal();
  const QuietGdal quiet;
  const std::filesystem::path part = file.string() + ".part";
  std::error_code error;
  if (!WriteRaster(part, surface, origin)) {
    const std::string reason = CPLGetLastErrorMsg();
    std::filesystem::remove(part, error);
    Refuse(file, fmt::format("cannot be written ({}); check the folder, its permissions and the "
                             "space on the disk",
                             reason));
  }
  std::filesystem::rename(part, file, error);
  if (error) Refuse(file, fmt::format("cannot be put in place ({})", error.message()));
}

}  // namespace tera
