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

/// GDAL with its drivers registered and its messages kept for our own, as long as this lives.
class QuietGdal {
 public:
  QuietGdal();
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

using RasterFile = std::unique_ptr<GDALDataset, decltype(&GDALClose)>;

/// Throws the InputError of a file that cannot be used.
[[noreturn]] void Refuse(const std::filesystem::path& file, const InputFault& fault);

/// Where the pixels of a file lie.
struct RasterFrame {
  int nx = 0, ny = 0;
  std::array<double, 6> affine{};  ///< GDAL's geotransform
  OGRSpatialReference projection;

  /// Place of the pixel (i, j)'s centre, j counted from the south.
  Vec2 PlaceOf(double i, double j) const {
    return {affine[0] + (i + 0.5) * affine[1], affine[3] + (ny - 0.5 - j) * affine[5]};
  }
  /// The pixel at a place, in fractions of pixels.
  Vec2 PixelAt(const Vec2& place) const {
    return {(place.x() - affine[0]) / affine[1] - 0.5,
            ny - 0.5 - (place.y() - affine[3]) / affine[5]};
  }
};

/// Opens a one-band raster. `content` names the needed raster, for messages: "elevation raster".
RasterFile OpenRaster(const std::filesystem::path& file, std::string_view content);

/// The raster's file, and those beside it that GDAL reads with it (.tfw, .aux.xml).
std::vector<std::filesystem::path> FilesOf(GDALDataset* raster);

/// Projection, geotransform and size of a file. Refuses one without them, one that is not north-up,
/// and one of more pixels than fit into memory with all that is made of them.
RasterFrame ReadFrame(const std::filesystem::path& file, GDALDataset* raster);

/// The meaning of a band's stored numbers: its scale times them, plus its offset.
struct BandScaling {
  explicit BandScaling(GDALRasterBand* band) : scale(band->GetScale()), offset(band->GetOffset()) {}
  double Value(double stored) const { return scale * stored + offset; }
  double Stored(double value) const { return (value - offset) / scale; }

  double scale, offset;
};

/// Values of a file's only band, scaled, rows from the south.
std::vector<double> ReadBand(const std::filesystem::path& file, GDALDataset* raster);

/// Heights of a file's only band in metres, rows from the south; NaN where a pixel has none.
///
/// Model   the unit is the band's, else that of the vertical reference system, else the metre. A
///         pixel has no height where the file's no-data value or mask says so.
/// Throws InputError for a unit that is not known, for a map in feet whose heights have no unit,
/// and for pixels so far from all others that they must stand for no height without being marked.
std::vector<double> ReadHeights(const std::filesystem::path& file, GDALDataset* raster);

/// Transverse Mercator about `origin`, whose axes are east and north there.
OGRSpatialReference SitePlane(const SiteOrigin& origin);

/// OGC WKT of a reference system.
std::string WktOf(const OGRSpatialReference& system);

/// Geodetic place of the middle of a file, height zero.
SiteOrigin MiddleOf(const std::filesystem::path& file, const RasterFrame& frame);

/// Spacing of the pixels about the middle, in the site's plane.
Vec2 PixelSize_m(const std::filesystem::path& file, const RasterFrame& frame,
                 const OGRSpatialReference& plane);

/// Moves places from one reference system to another, or refuses the file.
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

/// Drop of the ellipsoid below its tangent plane at latitude `lat_deg`, east and north of the point
/// of contact. It is the parabola of the two main curvatures of WGS 84.
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
