#pragma once

#include <array>
#include <vector>

#include "core/motion.h"
#include "render/air/weather.h"
#include "sim/dust/emission.h"

namespace tera {

/// The air over a site in layers that follow the ground.
struct DustAir {
  std::vector<Vec2> wind_W_mps;          ///< of each layer
  std::vector<double> diffusivity_m2ps;  ///< of each layer
};

/// The neutral surface layer: wind u* / k ln(z / z0) with k = 0.4 and z0 = 5 mm, eddy diffusivity k
/// u* z in all directions, and no less than kStirred_m2ps, since machines stir still air too (this
/// project's estimate).
/// Source: Seinfeld and Pandis, Atmospheric Chemistry and Physics, 2nd ed. 2006, section 16.4
/// (logarithmic wind), 18.12 (eddy diffusivity of the surface layer).
DustAir NeutralAir(const Wind& wind, int layers, double layer_m);
inline constexpr double kStirred_m2ps = 0.08;

/// The cells that dust is followed in.
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
  double HeightAbove(const Vec3& p_W_m) const;  ///< of a point over its column's base
};

/// Dust in the air: what comes in, is carried by the wind, spreads and comes down.
///
/// Frames  W.
/// Model   for each size c_t + u . grad c - w_s c_z = div (K grad c), in finite volumes, one axis
///         after the other: carried by fluxes of second order whose slopes are limited, settled by
///         upwind ones at Stokes' speed, spread by central ones; steps are short enough that no
///         cell gives more than it has. What reaches the ground stays there, what crosses the other
///         borders has left, so that emitted = airborne + settled + left.
/// Omits   buoyancy, the air that machines and falling soil push along, walls and machines in the
///         way, clumping, what rain washes out.
/// Source  van Leer 1977, "Towards the ultimate conservative difference scheme IV", J. Comput.
///         Phys. 23 (monotonised central slopes); sizes and Stokes: emission.h.
class DustField {
 public:
  DustField(DustGrid grid, DustAir air);

  /// Puts dust into a ball about a point.
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

  /// Cells beyond which there is no dust.
  struct Reach {
    std::array<int, 3> low{}, high{};  ///< from low to before high
    bool is_empty() const { return low[0] >= high[0]; }
  };
  const Reach& reach() const { return reach_; }

 private:
  /// What moves across a row of cells along one axis.
  struct Row {
    std::size_t first, stride;
    int from, to;                        ///< cells of it to be looked at
    bool is_open_below, is_open_beyond;  ///< whether its ends are borders, else nothing crosses
    double speed_mps;                    ///< along the axis
    const double* face_m2ps;  ///< diffusivity of each face below a cell; null: uniform_m2ps
    double uniform_m2ps;
    bool is_upwind;                ///< of first order
    double *below_kg, *beyond_kg;  ///< where that goes which leaves through the ends
  };
  void Carry(double dt_s, const Row& row, std::vector<double>* cells_kg);
  void CarryAll(int axis, int size, double dt_s, const Vec2& gust_W_mps);
  bool HasDust(int axis, int layer) const;
  void Grow(int axis);
  double LongestStep_s(const Vec2& gust_W_mps) const;

  DustGrid grid_;
  DustAir air_;
  std::vector<double> face_m2ps_;  ///< diffusivity between a layer and the one below
  std::array<std::vector<double>, kDustSizes> cells_kg_;
  DustMass emitted_kg_{}, settled_kg_{}, left_kg_{};
  Reach reach_;
  std::vector<double> flux_;
};

/// Speed at which dust of each size falls, and the area that a kilogram of it takes out of the
/// light.
///
/// Model   Stokes' at the geometric mean of a size's bounds, in aerodynamic diameter (1, 5 and 17.3
///         um; of unit density). Extinction of the first two as measured on fine and coarse mineral
///         dust, of the third 3 Q / (2 rho d) with Q = 2 and d the diameter of grains of that size.
/// Source  Pitchford et al. 2007, J. Air Waste Manage. Assoc. 57 (IMPROVE: fine soil 1 m^2/g,
///         coarse mass 0.6 m^2/g); Bohren and Huffman 1983, section 4.4.3 (Q = 2 of large grains).
double SettlingSpeed_mps(int size);
double Extinction_m2pkg(int size);

}  // namespace tera
