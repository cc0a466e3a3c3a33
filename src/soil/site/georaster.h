#pragma once

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "soil/soil.h"

namespace tera {

/// Registers GDAL's drivers and suppresses its messages while this object lives.
class QuietGdal {
 public:
  QuietGdal();
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

using RasterFile = std::unique_ptr<GDALDataset, decltype(&GDALClose)>;

/// Throws an InputError for a file that cannot be used.
[[noreturn]] void Refuse(const std::filesystem::path& file, const InputFault& fault);

/// Georeference of the pixels of a file.
struct RasterFrame {
  int nx = 0, ny = 0;
  std::array<double, 6> affine{};  ///< GDAL's geotransform
  OGRSpatialReference projection;

  /// Position of the centre of pixel (i, j); j counts from the south.
  Vec2 PlaceOf(double i, double j) const {
    return {affine[0] + (i + 0.5) * affine[1], affine[3] + (ny - 0.5 - j) * affine[5]};
  }
  /// Pixel at a position, in fractions of pixels.
  Vec2 PixelAt(const Vec2& place) const {
    return {(place.x() - affine[0]) / affine[1] - 0.5,
            ny - 0.5 - (place.y() - affine[3]) / affine[5]};
  }
};

/// Opens a one-band raster. `content` describes it in messages, for example "elevation raster".
RasterFile OpenRaster(const std::filesystem::path& file, std::string_view content);

/// The raster file and the sidecar files that GDAL reads (.tfw, .aux.xml).
std::vector<std::filesystem::path> FilesOf(GDALDataset* raster);

/// Reads projection, geotransform and size. Refuses a file without them, one that is not north-up,
/// and one of more than 2.5e7 pixels.
RasterFrame ReadFrame(const std::filesystem::path& file, GDALDataset* raster);

/// Converts the stored numbers of a band to values: scale * stored + offset.
struct BandScaling {
  explicit BandScaling(GDALRasterBand* band) : scale(band->GetScale()), offset(band->GetOffset()) {}
  double Value(double stored) const { return scale * stored + offset; }
  double Stored(double value) const { return (value - offset) / scale; }

  double scale, offset;
};

/// Scaled values of the only band of a file, row by row from the south.
std::vector<double> ReadBand(const std::filesystem::path& file, GDALDataset* raster);

/// Heights of the only band of a file in metres, row by row from the south; NaN for a missing
/// height.
///
/// Model   The unit is that of the band, else that of the vertical reference system, else the
///         metre. A pixel has no height where the no-data value or the mask of the file says so.
/// Throws  InputError for an unknown unit, and for a map in feet whose heights have no unit. Also
///         for outliers that must be unmarked missing heights.
std::vector<double> ReadHeights(const std::filesystem::path& file, GDALDataset* raster);

/// Transverse Mercator plane about `origin`, with axes east and north at the origin.
OGRSpatialReference SitePlane(const SiteOrigin& origin);

/// OGC WKT of a reference system.
std::string WktOf(const OGRSpatialReference& system);

/// Geodetic position of the middle of a file, with height zero.
SiteOrigin MiddleOf(const std::filesystem::path& file, const RasterFrame& frame);

/// Size of the pixel in the middle of a file, in the plane of the site.
Vec2 PixelSize_m(const std::filesystem::path& file, const RasterFrame& frame,
                 const OGRSpatialReference& plane);

/// Converts positions between reference systems. Refuses the file if there is no conversion.
class Conversion {
 public:
  Conversion(const std::filesystem::path& file, const OGRSpatialReference& from,
             const OGRSpatialReference& to);
  void Apply(std::vector<double>* x, std::vector<double>* y) const;

 private:
  std::filesystem::path file_;
  std::unique_ptr<OGRCoordinateTransformation, decltype(&OGRCoordinateTransformation::DestroyCT)>
      transformation_;
};

/// Drop of the ellipsoid below its tangent plane at latitude `lat_deg`; x east, y north of the
/// point of contact. It is the parabola of the two principal curvatures of WGS 84.
class EllipsoidDrop {
 public:
  explicit EllipsoidDrop(double lat_deg);
  double At_m(double x_m, double y_m) const {
    return 0.5 * (x_m * x_m / normal_m_ + y_m * y_m / meridian_m_);
  }

 private:
  double normal_m_ = 0, meridian_m_ = 0;
};

}  // namespace tera
