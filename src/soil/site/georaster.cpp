#include "soil/site/georaster.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/error.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr double kMostPixels = 2.5e7;  ///< of a file that is read: 600 MB while it is

}  // namespace

QuietGdal::QuietGdal() {
  static const bool registered = [] {
    GDALAllRegister();
    return true;
  }();
  (void)registered;
  CPLPushErrorHandler(CPLQuietErrorHandler);
}

void Refuse(const std::filesystem::path& file, const std::string& finding) {
  throw InputError(fmt::format("{}: {}", file.string(), finding));
}

RasterFile OpenRaster(const std::filesystem::path& file, std::string_view content) {
  RasterFile raster(static_cast<GDALDataset*>(GDALOpen(file.c_str(), GA_ReadOnly)), &GDALClose);
  if (!raster) {
    Refuse(file, fmt::format("not readable as a GeoTIFF ({}); give a one-band {}",
                             CPLGetLastErrorMsg(), content));
  }
  if (raster->GetRasterCount() != 1) {
    Refuse(file,
           fmt::format("{} bands found, need a one-band {}", raster->GetRasterCount(), content));
  }
  return raster;
}

std::vector<std::filesystem::path> FilesOf(GDALDataset* raster) {
  char** names = raster->GetFileList();
  const std::vector<std::filesystem::path> files(names, names + CSLCount(names));
  CSLDestroy(names);
  return files;
}

RasterFrame ReadFrame(const std::filesystem::path& file, GDALDataset* raster) {
  RasterFrame frame;
  const OGRSpatialReference* projection = raster->GetSpatialRef();
  if (!projection || raster->GetGeoTransform(frame.affine.data()) != CE_None) {
    Refuse(file,
           "has no projection or no geotransform; add them with gdal_translate -a_srs "
           "and -a_ullr");
  }
  const std::array<double, 6>& affine = frame.affine;
  if (affine[2] != 0 || affine[4] != 0 || affine[1] <= 0 || affine[5] >= 0) {
    Refuse(file, "is rotated or not north-up; warp it with gdalwarp first");
  }
  frame.nx = raster->GetRasterXSize();
  frame.ny = raster->GetRasterYSize();
  if (frame.nx < 2 || frame.ny < 2) {
    Refuse(file, fmt::format("{} x {} pixels found, need at least 2 x 2", frame.nx, frame.ny));
  }
  if (static_cast<double>(frame.nx) * frame.ny > kMostPixels) {
    Refuse(file, fmt::format("{} x {} pixels found, need at most {}; make them larger with "
                             "gdalwarp -tr, or cut out the site with gdalwarp -te",
                             frame.nx, frame.ny, kMostPixels));
  }
  frame.projection = *projection;
  frame.projection.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return frame;
}

template <typename T>
std::vector<T> ReadBand(const std::filesystem::path& file, GDALDataset* raster, GDALDataType type) {
  const int nx = raster->GetRasterXSize(), ny = raster->GetRasterYSize();
  std::vector<T> pixels(static_cast<std::size_t>(nx) * ny);
  // The file's first row is the northernmost: the lines are laid down backwards.
  T* last_row = pixels.data() + static_cast<std::size_t>(ny - 1) * nx;
  const GSpacing line = -static_cast<GSpacing>(nx) * static_cast<GSpacing>(sizeof(T));
  if (raster->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, nx, ny, last_row, nx, ny, type, 0, line) !=
      CE_None) {
    Refuse(file, fmt::format("its pixels cannot be read ({}); the file may be truncated",
                             CPLGetLastErrorMsg()));
  }
  return pixels;
}

template std::vector<double> ReadBand(const std::filesystem::path&, GDALDataset*, GDALDataType);
template std::vector<std::uint8_t> ReadBand(const std::filesystem::path&, GDALDataset*,
                                            GDALDataType);

OGRSpatialReference SitePlane(const SiteOrigin& origin) {
  OGRSpatialReference plane;
  plane.SetProjCS("Site plane");
  plane.SetWellKnownGeogCS("WGS84");
  plane.SetTM(origin.lat_deg, origin.lon_deg, 1.0, 0.0, 0.0);
  plane.SetLinearUnits(SRS_UL_METER, 1.0);
  return plane;
}

std::string WktOf(const OGRSpatialReference& system) {
  char* text = nullptr;
  system.exportToWkt(&text);
  std::string wkt = text ? text : "";
  CPLFree(text);
  return wkt;
}

SiteOrigin MiddleOf(const std::filesystem::path& file, const RasterFrame& frame) {
  OGRSpatialReference wgs84;
  wgs84.SetWellKnownGeogCS("WGS84");
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const Vec2 middle = frame.PlaceOf(0.5 * (frame.nx - 1), 0.5 * (frame.ny - 1));
  std::vector<double> lon_deg = {middle.x()}, lat_deg = {middle.y()};
  Conversion(file, frame.projection, wgs84).Apply(&lon_deg, &lat_deg);
  return {lat_deg[0], lon_deg[0], 0};
}

Vec2 PixelSize_m(const std::filesystem::path& file, const RasterFrame& frame,
                 const OGRSpatialReference& plane) {
  const double i = 0.5 * (frame.nx - 1), j = 0.5 * (frame.ny - 1);
  std::vector<double> x, y;
  for (const Vec2& place : {frame.PlaceOf(i - 0.5, j), frame.PlaceOf(i + 0.5, j),
                            frame.PlaceOf(i, j - 0.5), frame.PlaceOf(i, j + 0.5)}) {
    x.push_back(place.x());
    y.push_back(place.y());
  }
  Conversion(file, frame.projection, plane).Apply(&x, &y);
  return {std::hypot(x[1] - x[0], y[1] - y[0]), std::hypot(x[3] - x[2], y[3] - y[2])};
}

Conversion::Conversion(const std::filesystem::path& file, const OGRSpatialReference& from,
                       const OGRSpatialReference& to)
    : file_(file),
      transformation_(OGRCreateCoordinateTransformation(&from, &to),
                      &OGRCoordinateTransformation::DestroyCT) {}

void Conversion::Apply(std::vector<double>* x, std::vector<double>* y) const {
  if (!transformation_ ||
      !transformation_->Transform(static_cast<int>(x->size()), x->data(), y->data())) {
    Refuse(file_,
           "its reference system cannot be converted to that of the site (WGS 84, near by); "
           "reproject it with gdalwarp");
  }
}

EllipsoidDrop::EllipsoidDrop(double lat_deg) {
  constexpr double kSemiMajor_m = 6378137.0, kFlattening = 1 / 298.257223563;
  constexpr double kE2 = kFlattening * (2 - kFlattening);
  const double s = std::sin(lat_deg * kDeg);
  const double w = 1 - kE2 * s * s;
  normal_m_ = kSemiMajor_m / std::sqrt(w);
  meridian_m_ = kSemiMajor_m * (1 - kE2) / (w * std::sqrt(w));
}

}  // namespace tera
