#include "soil/site/geotiff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "soil/site/georaster.h"

namespace tera {
namespace {

/// Bilinear value at the grid coordinates (gx, gy).
double Bilinear(const std::vector<double>& values, int nx, int ny, double gx, double gy) {
  gx = std::clamp(gx, 0.0, nx - 1.0);
  gy = std::clamp(gy, 0.0, ny - 1.0);
  const int i = std::min(static_cast<int>(gx), nx - 2), j = std::min(static_cast<int>(gy), ny - 2);
  const double u = gx - i, v = gy - j;
  const double* row = &values[static_cast<std::size_t>(j) * nx + i];
  return (1 - v) * ((1 - u) * row[0] + u * row[1]) + v * ((1 - u) * row[nx] + u * row[nx + 1]);
}

/// Heights of a raster; refuses missing heights.
std::vector<double> ReadAllHeights(const std::filesystem::path& file, GDALDataset* raster) {
  std::vector<double> height_m = ReadHeights(file, raster);
  const auto gaps =
      std::count_if(height_m.begin(), height_m.end(), [](double z_m) { return std::isnan(z_m); });
  if (gaps > 0) {
    Refuse(file, {FaultKind::kMissing,
                  fmt::format("{} of {} pixels have no height; fill the gaps, e.g. with "
                              "gdal_fillnodata.py",
                              gaps, height_m.size())});
  }
  return height_m;
}

/// Converts a value of the file to a class, or refuses the file.
std::uint8_t ClassOf(const std::filesystem::path& file, double value) {
  constexpr double kMost = 255;
  if (value < 0 || value > kMost || value != std::floor(value)) {
    Refuse(file, {FaultKind::kMistyped,
                  fmt::format("a class of {:g} found by its scale and offset, need whole numbers "
                              "from 0 to {}; take them off with gdal_translate -unscale -ot Byte",
                              value, kMost)});
  }
  return static_cast<std::uint8_t>(value);
}

/// Calls visit(x_m, y_m, pixel) for each point of a grid in the plane of the site, row by row.
/// `pixel` is the point in fractional pixels of the file.
template <typename Visit>
void ForPixelsOfGrid(const std::filesystem::path& file, const RasterFrame& frame,
                     const OGRSpatialReference& plane, const Vec2& first_m, const Vec2& cell_m,
                     int nx, int ny, Visit visit) {
  const Conversion to_file(file, plane, frame.projection);
  for (int j = 0; j < ny; ++j) {
    const double y_m = first_m.y() + j * cell_m.y();
    std::vector<double> x, y(nx, y_m);
    for (int i = 0; i < nx; ++i) x.push_back(first_m.x() + i * cell_m.x());
    to_file.Apply(&x, &y);
    for (int i = 0; i < nx; ++i) {
      visit(first_m.x() + i * cell_m.x(), y_m, frame.PixelAt(Vec2(x[i], y[i])));
    }
  }
}

/// Sets the size and origin of the smallest grid of the plane that encloses the file.
void Enclose(const std::filesystem::path& file, const RasterFrame& frame,
             const OGRSpatialReference& plane, SoilClassGrid* grid) {
  std::vector<double> x, y;
  for (const double i : {0.0, 0.5 * (frame.nx - 1), frame.nx - 1.0}) {
    for (const double j : {0.0, 0.5 * (frame.ny - 1), frame.ny - 1.0}) {
      x.push_back(frame.PlaceOf(i, j).x());
      y.push_back(frame.PlaceOf(i, j).y());
    }
  }
  Conversion(file, frame.projection, plane).Apply(&x, &y);
  const auto [west, east] = std::minmax_element(x.begin(), x.end());
  const auto [south, north] = std::minmax_element(y.begin(), y.end());
  grid->nx = 1 + static_cast<int>(std::lround((*east - *west) / grid->cell_m.x()));
  grid->ny = 1 + static_cast<int>(std::lround((*north - *south) / grid->cell_m.y()));
  grid->first_m =
      0.5 * (Vec2(*west + *east, *south + *north) -
             Vec2((grid->nx - 1) * grid->cell_m.x(), (grid->ny - 1) * grid->cell_m.y()));
}

}  // namespace

double ElevationGrid::HeightAt(double x_m, double y_m) const {
  return Bilinear(height_m, nx, ny, (x_m + 0.5 * width_m()) / cell_x_m,
                  (y_m + 0.5 * depth_m()) / cell_y_m);
}

ElevationGrid ReadElevation(const std::filesystem::path& file) {
  const QuietGdal quiet;
  const RasterFile raster = OpenRaster(file, "elevation raster, heights in metres");
  const RasterFrame frame = ReadFrame(file, raster.get());
  const std::vector<double> pixel_m = ReadAllHeights(file, raster.get());
  const auto height_at = [&](const Vec2& pixel) {
    return Bilinear(pixel_m, frame.nx, frame.ny, pixel.x(), pixel.y());
  };

  ElevationGrid grid;
  grid.files = FilesOf(raster.get());
  grid.nx = frame.nx;
  grid.ny = frame.ny;
  grid.origin = MiddleOf(file, frame);
  grid.origin.height_m = height_at(Vec2(0.5 * (frame.nx - 1), 0.5 * (frame.ny - 1)));
  const OGRSpatialReference plane = SitePlane(grid.origin);
  const Vec2 cell_m = PixelSize_m(file, frame, plane);
  grid.cell_x_m = cell_m.x();
  grid.cell_y_m = cell_m.y();
  const EllipsoidDrop drop(grid.origin.lat_deg);
  ForPixelsOfGrid(
      file, frame, plane, -0.5 * Vec2(grid.width_m(), grid.depth_m()), cell_m, grid.nx, grid.ny,
      [&](double x_m, double y_m, const Vec2& pixel) {
        grid.height_m.push_back(height_at(pixel) - grid.origin.height_m - drop.At_m(x_m, y_m));
      });
  return grid;
}

SoilClassGrid ReadSoilClasses(const std::filesystem::path& file,
                              const std::optional<SiteOrigin>& about) {
  const QuietGdal quiet;
  const RasterFile raster = OpenRaster(file, "raster of soil classes, one byte a pixel");
  const RasterFrame frame = ReadFrame(file, raster.get());
  GDALRasterBand* band = raster->GetRasterBand(1);
  if (band->GetRasterDataType() != GDT_Byte) {
    Refuse(file, {FaultKind::kUnsupported,
                  fmt::format("its pixels are {}, need classes as Byte; convert them with "
                              "gdal_translate -ot Byte",
                              GDALGetDataTypeName(band->GetRasterDataType()))});
  }
  const std::vector<double> pixels = ReadBand(file, raster.get());

  SoilClassGrid grid;
  grid.files = FilesOf(raster.get());
  grid.origin = about ? *about : MiddleOf(file, frame);
  int has_gap_value = 0;
  const double gap_value = band->GetNoDataValue(&has_gap_value);
  if (has_gap_value && gap_value >= 0 && gap_value <= 255) {
    grid.gap_value = ClassOf(file, BandScaling(band).Value(gap_value));
  }
  const OGRSpatialReference plane = SitePlane(grid.origin);
  grid.cell_m = PixelSize_m(file, frame, plane);
  Enclose(file, frame, plane, &grid);
  ForPixelsOfGrid(
      file, frame, plane, grid.first_m, grid.cell_m, grid.nx, grid.ny,
      [&](double, double, const Vec2& pixel) {
        const auto i = std::clamp(std::lround(pixel.x()), 0L, frame.nx - 1L);
        const auto j = std::clamp(std::lround(pixel.y()), 0L, frame.ny - 1L);
        grid.value.push_back(ClassOf(
            file, pixels[static_cast<std::size_t>(j) * frame.nx + static_cast<std::size_t>(i)]));
      });
  return grid;
}

}  // namespace tera
