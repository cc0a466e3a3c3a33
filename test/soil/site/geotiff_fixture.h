#pragma once

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/motion.h"
#include "own_folder.h"

/// Rasters as GDAL alone reads and writes them.

namespace tera::testing_soil {

/// A folder of its own for each test that writes.
class FolderTest : public ::testing::Test {
 protected:
  std::string File(const std::string& name) const { return (folder_ / name).string(); }

  const std::filesystem::path folder_ = OwnFolder();
};

/// A raster read back, rows from the north as in the file.
struct ReadRaster {
  explicit ReadRaster(const std::string& file) {
    GDALAllRegister();
    dataset.reset(static_cast<GDALDataset*>(GDALOpen(file.c_str(), GA_ReadOnly)));
    if (!dataset) throw std::runtime_error(file + " cannot be opened");
    nx = dataset->GetRasterXSize();
    ny = dataset->GetRasterYSize();
    dataset->GetGeoTransform(affine.data());
    value.resize(static_cast<std::size_t>(nx) * ny);
    if (dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, nx, ny, value.data(), nx, ny,
                                            GDT_Float64, 0, 0) != CE_None) {
      throw std::runtime_error(file + " cannot be read");
    }
  }
  /// Pixel that covers (x, y) of the file's reference system.
  double At(double x, double y) const {
    const int i = static_cast<int>((x - affine[0]) / affine[1]);
    const int row = static_cast<int>((y - affine[3]) / affine[5]);
    return value.at(static_cast<std::size_t>(row) * nx + i);
  }
  double Sum() const {
    double sum = 0;
    for (const double v : value) sum += v;
    return sum;
  }
  double pixel_m2() const { return affine[1] * -affine[5]; }
  GDALRasterBand* band() const { return dataset->GetRasterBand(1); }

  struct Close {
    void operator()(GDALDataset* d) const { GDALClose(d); }
  };
  std::unique_ptr<GDALDataset, Close> dataset;
  int nx = 0, ny = 0;
  std::array<double, 6> affine{};
  std::vector<double> value;
};

/// Writes `rows`, the northernmost first, in UTM zone 33 north with pixels of `pixel_m` whose
/// north- west corner is `corner`.
inline void WriteUtmRaster(const std::string& file, const std::vector<std::vector<double>>& rows,
                           double pixel_m, const Vec2& corner = {500000, 5200000},
                           GDALDataType type = GDT_Byte, bool referenced = true) {
  GDALAllRegister();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const int nx = static_cast<int>(rows[0].size()), ny = static_cast<int>(rows.size());
  std::unique_ptr<GDALDataset, ReadRaster::Close> dataset(
      driver->Create(file.c_str(), nx, ny, 1, type, nullptr));
  std::array<double, 6> affine = {corner.x(), pixel_m, 0, corner.y(), 0, -pixel_m};
  if (referenced) {
    OGRSpatialReference utm;
    utm.SetWellKnownGeogCS("WGS84");
    utm.SetUTM(33, 1);
    dataset->SetSpatialRef(&utm);
    dataset->SetGeoTransform(affine.data());
  }
  for (int row = 0; row < ny; ++row) {
    std::vector<double> line = rows[row];
    ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, row, nx, 1, line.data(), nx, 1,
                                                  GDT_Float64, 0, 0),
              CE_None);
  }
}

/// Changes a file's description of its band.
template <typename Edit>
void EditBand(const std::string& file, Edit edit) {
  GDALAllRegister();
  std::unique_ptr<GDALDataset, ReadRaster::Close> dataset(
      static_cast<GDALDataset*>(GDALOpen(file.c_str(), GA_Update)));
  ASSERT_TRUE(dataset) << file;
  edit(dataset->GetRasterBand(1));
}

}  // namespace tera::testing_soil
