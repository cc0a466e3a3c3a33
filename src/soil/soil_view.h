#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/motion.h"

/// Queries of the ground, and rasters of it.

namespace tera {

/// A property of the ground as a map.
enum class GroundRaster {
  kHeight,      ///< height of the surface: m above the WGS 84 ellipsoid
  kChange,      ///< rise of the surface since the start in m
  kMassChange,  ///< mass gained since the start in kg/m^2
  kDensity,     ///< mean bulk density of the uppermost kDensityDepth_m in kg/m^3
  kSoilClass,   ///< soil at the surface, as an index into Soil::soils()
};

inline constexpr double kDensityDepth_m = 0.1;

/// Names in files and scenarios: height, change, mass_change, density, soil_class.
std::string_view NameOf(GroundRaster raster);

/// Soil at one position and depth.
struct SoilSample {
  std::uint8_t soil = 0;     ///< index into Soil::soils()
  double density_kgpm3 = 0;  ///< bulk density
  double compaction = 0;     ///< bulk density / that of the undisturbed soil
  double moisture = 0;       ///< degree of saturation, 0..1
  bool loose = false;        ///< dug or dumped, and not pressed since
};

/// A box of the ground, to be divided into cubes.
struct VoxelBox {
  Vec3 low_W_m = Vec3::Zero(), high_W_m = Vec3::Zero();
  int columns = 1;  ///< edge of a cube, in cells of the site
};

/// Soil in the cubes of a box.
///
/// Frames  W. Cube (i, j, k) has its lowest corner at low_W_m + edge_m * (i, j, k). Its index in
///         each list is (k * ny + j) * nx + i.
/// Model   Each cube sums the layers of its columns between its lower and upper face. Mass is
///         conserved within rounding. The box is shifted to the nearest border between columns and
///         enlarged to whole cubes. Cubes outside the site are empty.
struct SoilVoxels {
  static constexpr std::uint8_t kNoSoil = 255;

  Vec3 low_W_m = Vec3::Zero();
  double edge_m = 0;
  int nx = 0, ny = 0, nz = 0;
  std::vector<double> mass_kg;
  std::vector<float> fill;         ///< share of the cube that is soil, 0..1
  std::vector<float> compaction;   ///< bulk density / that of the undisturbed soil; 0 in air
  std::vector<float> moisture;     ///< degree of saturation, 0..1
  std::vector<float> loose;        ///< share of the mass that is loose, 0..1
  std::vector<std::uint8_t> soil;  ///< soil with the greatest mass; kNoSoil in air

  std::size_t size() const { return mass_kg.size(); }
  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * ny + j) * nx + i;
  }
};

/// Number of cubes along each axis of a box, for cells of `cell_m`.
Eigen::Array3i CubesOf(const VoxelBox& box, double cell_m);

}  // namespace tera
