#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "soil/site/georaster.h"

namespace tera {

/// One band of squares for output, row by row from the south; floats or bytes.
template <typename T>
struct SquareRaster {
  Vec2 low_m = Vec2::Zero();  ///< south-western corner of the first square, in the projection
  double square_m = 1;
  int nx = 0, ny = 0;
  const std::vector<T>& values;
  std::string unit, description;
  std::optional<double> no_data;
};

/// Writes a deflated GeoTIFF. False on failure; GDAL's last message then gives the reason.
template <typename T>
bool WriteSquares(const std::filesystem::path& file, const SquareRaster<T>& raster,
                  const OGRSpatialReference& projection) {
  constexpr GDALDataType kType = std::is_same_v<T, float> ? GDT_Float32 : GDT_Byte;
  static_assert(std::is_same_v<T, float> || std::is_same_v<T, std::uint8_t>);
  CPLErrorReset();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  CPLStringList options;
  options.AddString("COMPRESS=DEFLATE");
  RasterFile dataset(driver->Create(file.c_str(), raster.nx, raster.ny, 1, kType, options.List()),
                     &GDALClose);
  if (!dataset) return false;
  std::array<double, 6> affine = {
      raster.low_m.x(), raster.square_m, 0, raster.low_m.y() + raster.ny * raster.square_m, 0,
      -raster.square_m};
  GDALRasterBand* band = dataset->GetRasterBand(1);
  band->SetDescription(raster.description.c_str());
  bool written = dataset->SetSpatialRef(&projection) == CE_None &&
                 dataset->SetGeoTransform(affine.data()) == CE_None &&
                 band->SetUnitType(raster.unit.c_str()) == CE_None &&
                 (!raster.no_data || band->SetNoDataValue(*raster.no_data) == CE_None);
  std::vector<T> row(static_cast<std::size_t>(raster.nx));
  for (int j = 0; written && j < raster.ny; ++j) {
    // The first row is the northernmost.
    const auto first =
        raster.values.begin() + static_cast<std::ptrdiff_t>(raster.ny - 1 - j) * raster.nx;
    std::copy(first, first + raster.nx, row.begin());
    written = band->RasterIO(GF_Write, 0, j, raster.nx, 1, row.data(), raster.nx, 1, kType, 0, 0) ==
              CE_None;
  }
  dataset.reset();  // closes the file, which may still report an error
  return written && CPLGetLastErrorType() < CE_Failure;
}

}  // namespace tera
