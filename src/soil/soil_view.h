#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/motion.h"

/// Questions to the ground, and files written from it.

namespace tera {

/// A property of the ground from above, one number a place.
enum class GroundRaster {
  kHeight,      ///< of the surface: m above the WGS 84 ellipsoid
  kChange,      ///< m by which the surface has risen since the start
  kMassChange,  ///< kg/m^2 that the ground has gained since the start
  kDensity,     ///< kg/m^3: mean bulk density of the uppermost kDensityDepth_m
  kSoilClass,   ///< soil at the surface, as an index into Soil::soils()
};

inline constexpr double kDensityDepth_m = 0.1;

/// Names as in files and scenarios: height, change, mass_change, density, soil_class.
std::string_view NameOf(GroundRaster raster);

/// The ground at one place and depth.
struct SoilSample {
  std::uint8_t soil = 0;     ///< index into Soil::soils()
  double density_kgpm3 = 0;  ///< bulk density
  double compaction = 0;     ///< bulk density over that of the undisturbed soil
  double moisture = 0;       ///< degree of saturation, 0..1
  bool loose = false;        ///< dug or dumped, and not yet pressed
};

/// A box of the ground to be cut into cubes.
struct VoxelBox {
  Vec3 low_W_m = Vec3::Zero(), high_W_m = Vec3::Zero();
  int columns =
      1;  ///< that stand side by side in a cube: its edge is as many cells of the site long
};

/// The ground in cubes.
///
/// Frames  W. Cube (i, j, k) has its lowest corner at low_W_m + edge_m * (i, j, k) and stands at
///         (k * ny + j) * nx + i in each list.
/// Model   each column's layers are summed up between the heights of a cube: no mass is lost or
///         gained but by rounding. The box is moved to the nearest border between columns and made
///         larger to whole cubes. Beyond the site there is nothing.
struct SoilVoxels {
  static constexpr std::uint8_t kNoSoil = 255;

  Vec3 low_W_m = Vec3::Zero();
  double edge_m = 0;
  int nx = 0, ny = 0, nz = 0;
  std::vector<double> mass_kg;
  std::vector<float> fill;         ///< share of the cube that is soil, 0..1
  std::vector<float> compaction;   ///< bulk density over that of the undisturbed soil; 0 in air
  std::vector<float> moisture;     ///< degree of saturation, 0..1
  std::vector<float> loose;        ///< share of the mass that is loose, 0..1
  std::vector<std::uint8_t> soil;  ///< of which there is most; kNoSoil in air

  std::size_t size() const { return mass_kg.size(); }
  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * ny + j) * nx + i;
  }
};

/// Number of cubes along the axes of a box on cells of `cell_m`.
Eigen::Array3i CubesOf(const VoxelBox& box, double cell_m);

}  // namespace tera
