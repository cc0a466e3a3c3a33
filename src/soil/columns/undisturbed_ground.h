#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/types/terrain_surface.h"
#include "soil/soil.h"

namespace tera {

/// A stratum of the ground before anything has moved.
struct Stratum {
  double bottom_m = 0;  ///< depth of its lower end below the surface; infinite for the last one
  std::uint8_t soil = 0;
  float moisture = 0;  ///< degree of saturation, 0..1
  double density_kgpm3 = 0;
};

/// Strata from the surface down.
class GroundProfile {
 public:
  /// `strata` in order of depth, the last one without end.
  explicit GroundProfile(std::vector<Stratum> strata) : strata_(std::move(strata)) {}

  const std::vector<Stratum>& strata() const { return strata_; }
  /// The stratum that begins at, or goes on below, a depth.
  const Stratum& Below(double depth_m) const;
  /// Mass for each square metre between two depths.
  double Mass_kgpm2(double from_m, double to_m) const;

 private:
  std::vector<Stratum> strata_;
};

/// Where on a site another profile than its first one lies.
struct ProfileRegion {
  std::vector<Vec2> outline_W_m;  ///< a polygon that does not cross itself
  std::uint8_t profile = 0;

  bool Contains(const Vec2& p_W_m) const;
  /// Whether its outline passes through the rectangle.
  bool CrossesBox(const Vec2& low_W_m, const Vec2& high_W_m) const;
};

/// Profiles on a grid: that of the nearest cell, outside it the border's.
struct ProfileMap {
  int nx = 0, ny = 0;
  Vec2 first_W_m = Vec2::Zero();  ///< middle of cell (0, 0)
  Vec2 cell_m = Vec2::Zero();
  std::vector<std::uint8_t> profile;  ///< row-major, x fastest

  std::uint8_t At(const Vec2& p_W_m) const;
  /// Whether one profile covers the whole of the rectangle.
  bool IsUniform(const Vec2& low_W_m, const Vec2& high_W_m) const;

 private:
  int I(double x_m) const;
  int J(double y_m) const;
};

/// The ground before anything has moved, which need not be kept column by column.
///
/// Frames  W.
/// Model   heights at every `base_cells`-th vertex of the grid with plane triangles between them,
///         as in TerrainSurface; strata that follow the surface; the first profile everywhere, or
///         the map's; regions with strata of their own over it. The last region that holds a place
///         counts.
struct UndisturbedGround {
  TerrainGrid grid;
  int base_cells = 1;
  std::vector<double> base_height_m;
  std::vector<GroundProfile> profiles;
  std::optional<ProfileMap> map;
  std::vector<ProfileRegion> regions;

  double HeightAt(int i, int j) const;
  std::uint8_t ProfileAt(const Vec2& p_W_m) const;
  /// Whether one profile covers the whole of a tile.
  bool IsUniform(int a, int b) const;
  int base_nx() const { return BaseVertexCount(grid.nx, base_cells); }
  int base_ny() const { return BaseVertexCount(grid.ny, base_cells); }
};

/// Its visible surface; tiles with several profiles are refined.
TerrainSurface SurfaceOf(const UndisturbedGround& ground);

}  // namespace tera
