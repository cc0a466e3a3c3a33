#include "soil/site/ground_raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "core/check.h"
#include "soil/columns/ground_view.h"
#include "soil/site/file_in_place.h"
#include "soil/site/georaster.h"

namespace tera {
namespace {

constexpr int kBlock = 256;              ///< side of a compressed block, in pixels
constexpr int kWithoutOverviews = 2048;  ///< larger rasters get overviews, in pixels per side
constexpr int kSmallestOverview = 512;   ///< in pixels per side
constexpr int kCells = TerrainGrid::kTileCells;

/// One property of the ground, column by column. Undisturbed tiles of one profile need no columns.
class ColumnValues {
 public:
  ColumnValues(const Columns& columns, GroundRaster raster, const SiteOrigin& origin);
  double At(int i, int j) const;
  /// Value of a pixel that covers n x n columns from (i, j).
  double OfPixel(int i, int j, int n) const;

 private:
  double QuietDensity_kgpm3(const GroundProfile& profile) const {
    return profile.Mass_kgpm2(0, kDensityDepth_m) / kDensityDepth_m;
  }
  double MostCommon(int i0, int j0, int i1, int j1) const;

  const Columns& columns_;
  GroundRaster raster_;
  double height_m_;
  EllipsoidDrop drop_;
  std::vector<int> profile_of_tile_;  ///< -1 for a tile that needs its columns

  int TileOf(int i, int j) const {
    const TerrainGrid& grid = columns_.grid();
    return grid.tile_index(std::min(i / kCells, grid.tiles_x() - 1),
                           std::min(j / kCells, grid.tiles_y() - 1));
  }
  /// True if all columns from (i0, j0) to before (i1, j1) have the same value.
  bool IsOneValue(int i0, int j0, int i1, int j1) const {
    const int tile = TileOf(i0, j0);
    return raster_ != GroundRaster::kHeight && profile_of_tile_[tile] >= 0 &&
           tile == TileOf(i1 - 1, j1 - 1);
  }
};

ColumnValues::ColumnValues(const Columns& columns, GroundRaster raster, const SiteOrigin& origin)
    : columns_(columns), raster_(raster), height_m_(origin.height_m), drop_(origin.lat_deg) {
  const TerrainGrid& grid = columns.grid();
  for (int b = 0; b < grid.tiles_y(); ++b) {
    for (int a = 0; a < grid.tiles_x(); ++a) {
      const bool uniform = !columns.HasColumns(a, b) && columns.undisturbed().IsUniform(a, b);
      const Vec2 corner(grid.x_m(a * kCells), grid.y_m(b * kCells));
      profile_of_tile_.push_back(uniform ? columns.undisturbed().ProfileAt(corner) : -1);
    }
  }
}

double ColumnValues::At(int i, int j) const {
  if (raster_ == GroundRaster::kHeight) {
    return columns_.TopAt(i, j) + height_m_ + drop_.At_m(columns_.x_m(i), columns_.y_m(j));
  }
  if (raster_ == GroundRaster::kChange) return columns_.ChangeAt(i, j).height_m;
  if (raster_ == GroundRaster::kMassChange) return columns_.ChangeAt(i, j).kgpm2;
  const auto& profiles = columns_.profiles();
  const int quiet = profile_of_tile_[TileOf(i, j)];
  if (raster_ == GroundRaster::kSoilClass) {
    return quiet >= 0 ? profiles[quiet].strata().front().soil : columns_.SoilAt(i, j);
  }
  if (quiet >= 0) return QuietDensity_kgpm3(profiles[quiet]);
  const Column column = columns_.ColumnAt(i, j);
  return UpperDensity_kgpm3(column, profiles[column.profile], kDensityDepth_m);
}

double ColumnValues::OfPixel(int i, int j, int n) const {
  const int i1 = std::min(i + n, columns_.nx()), j1 = std::min(j + n, columns_.ny());
  if (n == 1 || IsOneValue(i, j, i1, j1)) return At(i, j);
  if (raster_ == GroundRaster::kSoilClass) return MostCommon(i, j, i1, j1);
  double sum = 0;
  for (int cj = j; cj < j1; ++cj) {
    for (int ci = i; ci < i1; ++ci) sum += At(ci, cj);
  }
  return sum / ((i1 - i) * (j1 - j));
}

double ColumnValues::MostCommon(int i0, int j0, int i1, int j1) const {
  std::array<int, 256> count{};
  for (int j = j0; j < j1; ++j) {
    for (int i = i0; i < i1; ++i) ++count[static_cast<std::size_t>(At(i, j))];
  }
  return static_cast<double>(std::max_element(count.begin(), count.end()) - count.begin());
}

struct Meaning {
  const char *unit, *description;
};

Meaning MeaningOf(GroundRaster raster) {
  switch (raster) {
    case GroundRaster::kHeight:
      return {"m", "height above the WGS 84 ellipsoid"};
    case GroundRaster::kChange:
      return {"m", "height gained since the start"};
    case GroundRaster::kMassChange:
      return {"kg/m^2", "mass gained since the start"};
    case GroundRaster::kDensity:
      return {"kg/m^3", "mean bulk density of the uppermost 0.1 m"};
    case GroundRaster::kSoilClass:
      return {"", "soil at the surface; SOIL_n of the metadata names soil n"};
  }
  TERA_CHECK(false, static_cast<int>(raster));
  return {};
}

/// A raster that is written to a file.
class Output {
 public:
  Output(const Columns& columns, GroundRaster raster, const SiteOrigin& origin, int n)
      : columns_(columns), raster_(raster), origin_(origin), n_(n) {
    nx_ = (columns.nx() - 1) / n + 1;
    ny_ = (columns.ny() - 1) / n + 1;
  }
  /// Writes and closes `file`. True if GDAL reports no error.
  bool Write(const std::filesystem::path& file) const;

 private:
  bool Describe(GDALDataset* dataset) const;
  bool WritePixels(GDALRasterBand* band) const;
  bool AddOverviews(GDALDataset* dataset) const;

  const Columns& columns_;
  GroundRaster raster_;
  SiteOrigin origin_;
  int n_, nx_ = 0, ny_ = 0;
};

bool Output::Write(const std::filesystem::path& file) const {
  CPLErrorReset();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const bool is_class = raster_ == GroundRaster::kSoilClass;
  CPLStringList options;
  for (const char* option : {"COMPRESS=DEFLATE", "ZLEVEL=1", "TILED=YES", "BIGTIFF=IF_SAFER"}) {
    options.AddString(option);
  }
  if (!is_class) options.AddString("PREDICTOR=3");
  RasterFile dataset(
      driver->Create(file.c_str(), nx_, ny_, 1, is_class ? GDT_Byte : GDT_Float32, options.List()),
      &GDALClose);
  if (!dataset) return false;
  const bool written = Describe(dataset.get()) && WritePixels(dataset->GetRasterBand(1)) &&
                       AddOverviews(dataset.get());
  dataset.reset();  // closes the file, which may still report an error
  return written && CPLGetLastErrorType() < CE_Failure;
}

bool Output::Describe(GDALDataset* dataset) const {
  const OGRSpatialReference projection = SitePlane(origin_);
  const double h = columns_.cell_m(), pixel_m = n_ * h;
  std::array<double, 6> affine = {columns_.x_m(0) - 0.5 * h,
                                  pixel_m,
                                  0,
                                  columns_.y_m(0) - 0.5 * h + ny_ * pixel_m,
                                  0,
                                  -pixel_m};
  const Meaning meaning = MeaningOf(raster_);
  GDALRasterBand* band = dataset->GetRasterBand(1);
  band->SetDescription(meaning.description);
  bool described = dataset->SetSpatialRef(&projection) == CE_None &&
                   dataset->SetGeoTransform(affine.data()) == CE_None &&
                   (*meaning.unit == '\0' || band->SetUnitType(meaning.unit) == CE_None);
  if (raster_ != GroundRaster::kSoilClass) return described;
  for (std::size_t k = 0; k < columns_.soils().size(); ++k) {
    described = described && dataset->SetMetadataItem(fmt::format("SOIL_{}", k).c_str(),
                                                      columns_.soils()[k].name.c_str()) == CE_None;
  }
  return described;
}

bool Output::WritePixels(GDALRasterBand* band) const {
  const ColumnValues values(columns_, raster_, origin_);
  std::vector<float> strip(static_cast<std::size_t>(nx_) * kBlock);
  for (int row0 = 0; row0 < ny_; row0 += kBlock) {
    const int rows = std::min(kBlock, ny_ - row0);
    for (int row = 0; row < rows; ++row) {
      const int j = (ny_ - 1 - (row0 + row)) * n_;  // the first row is the northernmost
      for (int i = 0; i < nx_; ++i) {
        strip[static_cast<std::size_t>(row) * nx_ + i] =
            static_cast<float>(values.OfPixel(i * n_, j, n_));
      }
    }
    if (band->RasterIO(GF_Write, 0, row0, nx_, rows, strip.data(), nx_, rows, GDT_Float32, 0, 0) !=
        CE_None) {
      return false;
    }
  }
  return true;
}

bool Output::AddOverviews(GDALDataset* dataset) const {
  const int side = std::max(nx_, ny_);
  if (side <= kWithoutOverviews) return true;
  std::vector<int> levels;
  for (int level = 2; side / level >= kSmallestOverview; level *= 2) levels.push_back(level);
  dataset->FlushCache();
  return dataset->BuildOverviews(raster_ == GroundRaster::kSoilClass ? "MODE" : "AVERAGE",
                                 static_cast<int>(levels.size()), levels.data(), 0, nullptr,
                                 GDALDummyProgress, nullptr) == CE_None;
}

}  // namespace

void WriteGroundRaster(const std::filesystem::path& file, const Columns& columns,
                       GroundRaster raster, const SiteOrigin& origin, int columns_per_pixel) {
  TERA_CHECK(columns_per_pixel > 0, columns_per_pixel);
  const QuietGdal quiet;
  PutInPlace(file, [&](const std::filesystem::path& part) -> std::optional<std::string> {
    if (Output(columns, raster, origin, columns_per_pixel).Write(part)) return std::nullopt;
    return CPLGetLastErrorMsg();
  });
}

}  // namespace tera
