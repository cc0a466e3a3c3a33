#include "soil/columns/ground_view.h"

#include <cmath>

#include "core/check.h"
#include "soil/columns/soil_type.h"

namespace tera {
namespace {

/// Share of a piece between two heights. A piece without height counts fully if it lies between
/// them.
double ShareBetween(const SoilPiece& piece, double low_m, double high_m) {
  const double height_m = piece.top_m - piece.bottom_m;
  if (height_m <= 0) return piece.top_m > low_m && piece.top_m <= high_m ? 1 : 0;
  return std::max(0.0, std::min(piece.top_m, high_m) - std::max(piece.bottom_m, low_m)) / height_m;
}

/// Bulk density over that of the undisturbed soil.
double CompactionOf(const SoilPiece& piece, const SoilType& soil) {
  const double height_m = piece.top_m - piece.bottom_m;
  const double density_kgpm3 = height_m > 0 ? piece.kgpm2 / height_m : LooseDensity_kgpm3(soil);
  return density_kgpm3 / soil.bank_density_kgpm3;
}

/// Sums over a vertical stack of cubes.
class CubeStack {
 public:
  CubeStack(double low_m, double edge_m, int count, const std::vector<SoilType>& soils)
      : low_m_(low_m), edge_m_(edge_m), count_(count), soils_(soils) {}

  void Clear() {
    sums_.assign(count_, {});
    mass_of_soil_kg_.assign(static_cast<std::size_t>(count_) * soils_.size(), 0);
  }
  void Add(const SoilPiece& piece, double area_m2);
  /// Writes the sums of cube `k` to index `at` of the lists.
  void Store(int k, std::size_t at, SoilVoxels* voxels) const;

 private:
  struct Sum {
    double mass_kg = 0, volume_m3 = 0, loose_kg = 0;
    double compaction_kg = 0, moisture_kg = 0;  ///< weighted by mass
  };

  double low_m_, edge_m_;
  int count_;
  const std::vector<SoilType>& soils_;
  std::vector<Sum> sums_;
  std::vector<double> mass_of_soil_kg_;
};

void CubeStack::Add(const SoilPiece& piece, double area_m2) {
  const auto cube_of = [&](double z_m) {
    return static_cast<int>(std::clamp(std::floor((z_m - low_m_) / edge_m_), -1.0, count_ + 0.0));
  };
  // One more cube on either side, so that rounding loses no soil at a border.
  const int first = std::max(0, cube_of(piece.bottom_m) - 1);
  const int last = std::min(count_ - 1, cube_of(piece.top_m) + 1);
  const double compaction = CompactionOf(piece, soils_[piece.soil]);
  for (int k = first; k <= last; ++k) {
    const double cube_m = low_m_ + k * edge_m_;
    const double share = ShareBetween(piece, cube_m, low_m_ + (k + 1) * edge_m_);
    if (share <= 0) continue;
    const double mass_kg = share * piece.kgpm2 * area_m2;
    Sum& sum = sums_[k];
    sum.mass_kg += mass_kg;
    sum.volume_m3 += share * (piece.top_m - piece.bottom_m) * area_m2;
    sum.loose_kg += piece.loose ? mass_kg : 0;
    sum.compaction_kg += compaction * mass_kg;
    sum.moisture_kg += piece.moisture * mass_kg;
    mass_of_soil_kg_[k * soils_.size() + piece.soil] += mass_kg;
  }
}

void CubeStack::Store(int k, std::size_t at, SoilVoxels* voxels) const {
  const Sum& sum = sums_[k];
  if (sum.mass_kg <= 0) return;
  const auto part = [&](double value) { return static_cast<float>(value / sum.mass_kg); };
  const auto begin = mass_of_soil_kg_.begin() + static_cast<std::ptrdiff_t>(k * soils_.size());
  const auto most = std::max_element(begin, begin + static_cast<std::ptrdiff_t>(soils_.size()));
  voxels->mass_kg[at] = sum.mass_kg;
  voxels->fill[at] =
      static_cast<float>(sum.volume_m3 / (voxels->edge_m * voxels->edge_m * voxels->edge_m));
  voxels->compaction[at] = part(sum.compaction_kg);
  voxels->moisture[at] = part(sum.moisture_kg);
  voxels->loose[at] = part(sum.loose_kg);
  voxels->soil[at] = static_cast<std::uint8_t>(most - begin);
}

}  // namespace

std::string_view NameOf(GroundRaster raster) {
  switch (raster) {
    case GroundRaster::kHeight:
      return "height";
    case GroundRaster::kChange:
      return "change";
    case GroundRaster::kMassChange:
      return "mass_change";
    case GroundRaster::kDensity:
      return "density";
    case GroundRaster::kSoilClass:
      return "soil_class";
  }
  TERA_CHECK(false, static_cast<int>(raster));
  return "";
}

Eigen::Array3i CubesOf(const VoxelBox& box, double cell_m) {
  constexpr double kRounding = 1e-6;  // tolerance for rounding, in cubes
  const double edge_m = box.columns * cell_m;
  return ((box.high_W_m - box.low_W_m).array() / edge_m - kRounding).ceil().max(1).cast<int>();
}

double UpperDensity_kgpm3(const Column& column, const GroundProfile& profile, double depth_m) {
  const double low_m = column.top_m - depth_m;
  double sum_kgpm2 = 0;
  ForPieces(column, profile, low_m, [&](const SoilPiece& piece) {
    sum_kgpm2 += piece.kgpm2 * ShareBetween(piece, low_m, column.top_m);
  });
  return sum_kgpm2 / depth_m;
}

std::optional<SoilSample> SampleBelow(const Columns& columns, double x_m, double y_m,
                                      double depth_m) {
  const int i = columns.NearestI(x_m), j = columns.NearestJ(y_m);
  if (!columns.Contains(i, j) || depth_m < 0) return std::nullopt;
  const Column column = columns.ColumnAt(i, j);
  const double z_m = column.top_m - depth_m;
  constexpr double kReach_m = 1e-6;  // below z, so that at least one piece is visited
  std::optional<SoilSample> sample;
  ForPieces(column, columns.profiles()[column.profile], z_m - kReach_m,
            [&](const SoilPiece& piece) {
              if (sample || piece.bottom_m >= z_m) return;
              const SoilType& soil = columns.soils()[piece.soil];
              sample = {.soil = piece.soil,
                        .density_kgpm3 = piece.kgpm2 / (piece.top_m - piece.bottom_m),
                        .compaction = CompactionOf(piece, soil),
                        .moisture = piece.moisture,
                        .loose = piece.loose};
            });
  return sample;
}

SoilVoxels CutIntoCubes(const Columns& columns, const VoxelBox& box) {
  TERA_CHECK(box.columns > 0 && (box.high_W_m.array() > box.low_W_m.array()).all(), box.columns);
  const Eigen::Array3i count = CubesOf(box, columns.cell_m());
  SoilVoxels voxels;
  voxels.nx = count.x();
  voxels.ny = count.y();
  voxels.nz = count.z();
  voxels.edge_m = box.columns * columns.cell_m();
  // A cell extends half a cell to each side of its column.
  const double half_m = 0.5 * columns.cell_m();
  const int i0 = columns.NearestI(box.low_W_m.x() + half_m);
  const int j0 = columns.NearestJ(box.low_W_m.y() + half_m);
  voxels.low_W_m = Vec3(columns.x_m(i0) - half_m, columns.y_m(j0) - half_m, box.low_W_m.z());
  const std::size_t size = static_cast<std::size_t>(voxels.nx) * voxels.ny * voxels.nz;
  voxels.mass_kg.resize(size);
  for (auto* list : {&voxels.fill, &voxels.compaction, &voxels.moisture, &voxels.loose}) {
    list->resize(size);
  }
  voxels.soil.assign(size, SoilVoxels::kNoSoil);

  CubeStack stack(voxels.low_W_m.z(), voxels.edge_m, voxels.nz, columns.soils());
  for (int b = 0; b < voxels.ny; ++b) {
    for (int a = 0; a < voxels.nx; ++a) {
      stack.Clear();
      for (int n = 0; n < box.columns * box.columns; ++n) {
        const int i = i0 + a * box.columns + n % box.columns;
        const int j = j0 + b * box.columns + n / box.columns;
        if (!columns.Contains(i, j)) continue;
        const Column column = columns.ColumnAt(i, j);
        ForPieces(column, columns.profiles()[column.profile], voxels.low_W_m.z(),
                  [&](const SoilPiece& piece) { stack.Add(piece, columns.area_m2()); });
      }
      for (int k = 0; k < voxels.nz; ++k) stack.Store(k, voxels.index(a, b, k), &voxels);
    }
  }
  return voxels;
}

}  // namespace tera
