#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/types/terrain_surface.h"
#include "soil/soil.h"

namespace tera {

/// A stratum of the ground before any change.
struct Stratum {
  double bottom_m = 0;  ///< depth of its lower end below the surface; infinite for the last stratum
  std::uint8_t soil = 0;
  float moisture = 0;  ///< degree of saturation, 0..1
  double density_kgpm3 = 0;
};

/// Strata from the surface down.
class GroundProfile {
 public:
  /// `strata` are sorted by depth; the last one has no lower end.
  explicit GroundProfile(std::vector<Stratum> strata) : strata_(std::move(strata)) {}

  const std::vector<Stratum>& strata() const { return strata_; }
  /// The stratum at a depth; at a boundary, the lower one.
  const Stratum& Below(double depth_m) const;
  /// Mass per square metre between two depths.
  double Mass_kgpm2(double from_m, double to_m) const;

 private:
  std::vector<Stratum> strata_;
};

/// A region of the site with a profile other than the first one.
struct ProfileRegion {
  std::vector<Vec2> outline_W_m;  ///< a polygon that does not cross itself
  std::uint8_t profile = 0;

  bool Contains(const Vec2& p_W_m) const;
  /// True if the outline passes through the rectangle.
  bool CrossesBox(const Vec2& low_W_m, const Vec2& high_W_m) const;
};

/// Profile indices on a grid. A point takes the nearest cell; outside the grid, the nearest border
/// cell.
struct ProfileMap {
  int nx = 0, ny = 0;
  Vec2 first_W_m = Vec2::Zero();  ///< middle of cell (0, 0)
  Vec2 cell_m = Vec2::Zero();
  std::vector<std::uint8_t> profile;  ///< row-major, x fastest

  std::uint8_t At(const Vec2& p_W_m) const;
  /// True if one profile covers the whole rectangle.
  bool IsUniform(const Vec2& low_W_m, const Vec2& high_W_m) const;

 private:
  int I(double x_m) const;
  int J(double y_m) const;
};

/// The ground before any change, stored more coarsely than by column.
///
/// Frames  W.
/// Model   Heights at every `base_cells`-th vertex of the grid, with plane triangles between them
///         as in TerrainSurface. Strata follow the surface. The profile of a point is that of the
///         last region that contains it, else that of the map, else the first one.
struct UndisturbedGround {
  TerrainGrid grid;
  int base_cells = 1;
  std::vector<double> base_height_m;
  std::vector<GroundProfile> profiles;
  std::optional<ProfileMap> map;
  std::vector<ProfileRegion> regions;

  double HeightAt(int i, int j) const;
  std::uint8_t ProfileAt(const Vec2& p_W_m) const;
  /// True if one profile covers the whole tile.
  bool IsUniform(int a, int b) const;
  int base_nx() const { return BaseVertexCount(grid.nx, base_cells); }
  int base_ny() const { return BaseVertexCount(grid.ny, base_cells); }
};

/// The visible surface. Tiles with several profiles store every vertex.
TerrainSurface SurfaceOf(const UndisturbedGround& ground);

}  // namespace tera
