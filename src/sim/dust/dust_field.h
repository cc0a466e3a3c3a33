#pragma once

#include <array>
#include <vector>

#include "core/motion.h"
#include "render/air/weather.h"
#include "sim/dust/emission.h"

namespace tera {

/// The air over a site in layers that follow the ground.
struct DustAir {
  std::vector<Vec2> wind_W_mps;          ///< one per layer
  std::vector<double> diffusivity_m2ps;  ///< one per layer
};

/// The neutral surface layer.
///
/// Model   wind u* / k ln(z / z0) with k = 0.4 and z0 = 5 mm. Eddy diffusivity k u* z in all
///         directions, at least kStirred_m2ps, since machines stir still air too (this project's
///         estimate).
/// Source  Seinfeld and Pandis, Atmospheric Chemistry and Physics, 2nd ed. 2006, section 16.4
///         (logarithmic wind), 18.12 (eddy diffusivity of the surface layer).
DustAir NeutralAir(const Wind& wind, int layers, double layer_m);
inline constexpr double kStirred_m2ps = 0.08;

/// The cells of the dust field.
///
/// Frames  W. Cell (i, j, k) stands over the square from origin_W_m + cell_m (i, j) on, between
///         cell_m k and cell_m (k + 1) above base_m of its column.
struct DustGrid {
  Vec2 origin_W_m = Vec2::Zero();
  double cell_m = 0.5;
  int nx = 0, ny = 0, nz = 0;
  std::vector<double> base_m;  ///< nx * ny, x fastest

  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * ny + j) * nx + i;
  }
  double HeightAbove(const Vec3& p_W_m) const;  ///< height of a point over its column's base
};

/// Dust in the air: emission, advection, diffusion and settling.
///
/// Frames  W.
/// Model   for each size c_t + u . grad c - w_s c_z = div (K grad c), in finite volumes, one axis
///         after the other. Advection uses second-order fluxes with limited slopes, settling uses
///         upwind fluxes at Stokes' speed, and diffusion uses central fluxes. Steps are short
///         enough that no cell gives more than it has. Dust that reaches the ground stays there;
///         dust that crosses the other borders leaves, so emitted = airborne + settled + left.
/// Omits   buoyancy, air displaced by machines and falling soil, walls and machines as obstacles,
///         clumping, washout by rain.
/// Source  van Leer 1977, "Towards the ultimate conservative difference scheme IV", J. Comput.
///         Phys. 23 (monotonised central slopes); sizes and Stokes: emission.h.
class DustField {
 public:
  DustField(DustGrid grid, DustAir air);

  /// Adds dust to a ball about a point.
  void Emit(const Vec3& centre_W_m, double radius_m, const DustMass& mass_kg);
  /// `gust_W_mps` adds to the wind of all layers.
  void Advance(double dt_s, const Vec2& gust_W_mps = Vec2::Zero());

  const DustGrid& grid() const { return grid_; }
  /// Mass of one size in each cell.
  const std::vector<double>& cells_kg(int size) const { return cells_kg_[size]; }

  struct Budget {
    DustMass emitted_kg{}, airborne_kg{}, settled_kg{}, left_kg{};
  };
  Budget budget() const;

  /// The range of cells that hold all dust.
  struct Reach {
    std::array<int, 3> low{}, high{};  ///< from low up to but excluding high
    bool is_empty() const { return low[0] >= high[0]; }
  };
  const Reach& reach() const { return reach_; }

 private:
  /// A row of cells along one axis, with the speed and diffusivity of its transport.
  struct Row {
    std::size_t first, stride;
    int from, to;  ///< range of cells
    bool is_open_below,
        is_open_beyond;       ///< the end is a border of the grid; nothing crosses other ends
    double speed_mps;         ///< along the axis
    const double* face_m2ps;  ///< diffusivity of each face below a cell; null: uniform_m2ps
    double uniform_m2ps;
    bool is_upwind;                ///< first order
    double *below_kg, *beyond_kg;  ///< receivers of the mass that leaves through the ends
  };
  void Carry(double dt_s, const Row& row, std::vector<double>* cells_kg);
  void CarryAll(int axis, int size, double dt_s, const Vec2& gust_W_mps);
  bool HasDust(int axis, int layer) const;
  void Grow(int axis);
  double LongestStep_s(const Vec2& gust_W_mps) const;

  DustGrid grid_;
  DustAir air_;
  std::vector<double> face_m2ps_;  ///< diffusivity between a layer and the layer below
  std::array<std::vector<double>, kDustSizes> cells_kg_;
  DustMass emitted_kg_{}, settled_kg_{}, left_kg_{};
  Reach reach_;
  std::vector<double> flux_;
};

/// Settling speed of dust of each size, and its mass extinction coefficient.
///
/// Model   Stokes' speed at the geometric mean of a size's bounds, in aerodynamic diameter (1, 5
///         and 17.3 um; unit density). Extinction of the first two sizes: as measured on fine and
///         coarse mineral dust. Third size: 3 Q / (2 rho d), with Q = 2 and grains of diameter d.
/// Source  Pitchford et al. 2007, J. Air Waste Manage. Assoc. 57 (IMPROVE: fine soil 1 m^2/g,
///         coarse mass 0.6 m^2/g); Bohren and Huffman 1983, section 4.4.3 (Q = 2 of large grains).
double SettlingSpeed_mps(int size);
double Extinction_m2pkg(int size);

}  // namespace tera
