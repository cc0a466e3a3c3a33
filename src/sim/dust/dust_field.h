#pragma once

#include <array>
#include <vector>

#include "core/motion.h"
#include "render/air/weather.h"
#include "sim/dust/emission.h"

namespace tera {

/// State of the air over a site, in layers that follow the ground.
struct DustAir {
  std::vector<Vec2> wind_W_mps;          ///< one per layer
  std::vector<double> diffusivity_m2ps;  ///< one per layer
};

/// The neutral surface layer.
///
/// Model   wind speed u* / k ln(z / z0), with k = 0.4 and z0 = 5 mm. Eddy diffusivity k u* z in all
///         directions, but at least kStirred_m2ps, because machines stir the air even without wind
///         (this project's estimate).
/// Source  Seinfeld and Pandis, Atmospheric Chemistry and Physics, 2nd ed. 2006, section 16.4
///         (logarithmic wind), 18.12 (eddy diffusivity of the surface layer).
DustAir NeutralAir(const Wind& wind, int layers, double layer_m);
inline constexpr double kStirred_m2ps = 0.08;

/// Grid of the dust field.
///
/// Frames  W. Cell (i, j, k) stands on the square with lower corner origin_W_m + cell_m (i, j). It
///         lies between the heights cell_m k and cell_m (k + 1) above its column's base_m.
struct DustGrid {
  Vec2 origin_W_m = Vec2::Zero();
  double cell_m = 0.5;
  int nx = 0, ny = 0, nz = 0;
  std::vector<double> base_m;  ///< nx * ny, x fastest

  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * ny + j) * nx + i;
  }
  double HeightAbove(const Vec3& p_W_m) const;  ///< height of a point above base_m of its column
};

/// Dust in the air: emission, advection, diffusion and settling.
///
/// Frames  W.
/// Model   c_t + u . grad c - w_s c_z = div (K grad c), separately for each particle size. Finite
///         volumes, one axis after the other. Advection: second-order fluxes with limited slopes.
///         Settling: first-order upwind fluxes at Stokes' speed. Diffusion: central fluxes. Time
///         steps are short enough that no cell loses more than its content.
///         Dust that reaches the ground stays there. Dust that crosses another border leaves the
///         field. Hence emitted = airborne + settled + left.
/// Omits   buoyancy, air displaced by machines and falling soil, walls and machines as obstacles,
///         clumping, washout by rain.
/// Source  van Leer 1977, "Towards the ultimate conservative difference scheme IV", J. Comput.
///         Phys. 23 (monotonised central slopes); sizes and Stokes: emission.h.
class DustField {
 public:
  DustField(DustGrid grid, DustAir air);

  /// Adds dust within a ball around a point.
  void Emit(const Vec3& centre_W_m, double radius_m, const DustMass& mass_kg);
  /// `gust_W_mps` adds to the wind of all layers.
  void Advance(double dt_s, const Vec2& gust_W_mps = Vec2::Zero());

  const DustGrid& grid() const { return grid_; }
  /// Dust mass in each cell, for one particle size.
  const std::vector<double>& cells_kg(int size) const { return cells_kg_[size]; }

  struct Budget {
    DustMass emitted_kg{}, airborne_kg{}, settled_kg{}, left_kg{};
  };
  Budget budget() const;

  /// Range of cells outside which there is no dust.
  struct Reach {
    std::array<int, 3> low{}, high{};  ///< low inclusive, high exclusive
    bool is_empty() const { return low[0] >= high[0]; }
  };
  const Reach& reach() const { return reach_; }

 private:
  /// A row of cells along one axis, with the parameters of its transport.
  struct Row {
    std::size_t first, stride;
    int from, to;  ///< range of cells
    bool is_open_below,
        /// Whether this end is a border of the grid; mass leaves only through such ends.
        is_open_beyond;
    double speed_mps;         ///< along the axis
    const double* face_m2ps;  ///< diffusivity at the lower face of each cell; null: uniform_m2ps
    double uniform_m2ps;
    bool is_upwind;  ///< first-order fluxes
    /// Accounts for mass that leaves through the lower and the upper end.
    double *below_kg, *beyond_kg;
  };
  void Carry(double dt_s, const Row& row, std::vector<double>* cells_kg);
  void CarryAll(int axis, int size, double dt_s, const Vec2& gust_W_mps);
  bool HasDust(int axis, int layer) const;
  void Grow(int axis);
  double LongestStep_s(const Vec2& gust_W_mps) const;

  DustGrid grid_;
  DustAir air_;
  std::vector<double> face_m2ps_;  ///< diffusivity between a layer and the layer below it
  std::array<std::vector<double>, kDustSizes> cells_kg_;
  DustMass emitted_kg_{}, settled_kg_{}, left_kg_{};
  Reach reach_;
  std::vector<double> flux_;
};

/// Settling speed of dust of each particle size, and its mass extinction coefficient.
///
/// Model   Stokes' speed at the geometric mean of the size's bounds, in aerodynamic diameter (1, 5
///         and 17.3 um at unit density). Extinction of the first two sizes: measured values of fine
///         and coarse mineral dust. Third size: 3 Q / (2 rho d) with Q = 2, for grains of diameter
///         d.
/// Source  Pitchford et al. 2007, J. Air Waste Manage. Assoc. 57 (IMPROVE: fine soil 1 m^2/g,
///         coarse mass 0.6 m^2/g); Bohren and Huffman 1983, section 4.4.3 (Q = 2 of large grains).
double SettlingSpeed_mps(int size);
double Extinction_m2pkg(int size);

}  // namespace tera
