#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Turbulent density fluctuations smaller than the cells of a dust cloud, as a density factor.
///
/// Model   log-normal with mean 1, periodic along each axis, advected by the wind as a whole
///         (frozen turbulence). Octaves start at a quarter of the period; their amplitude falls as
///         the cube root of their size, as in the inertial range.
/// Omits   evolution of eddies during advection.
/// Source  log-normal concentrations and their spread: Hanna 1984, "Concentration fluctuations in a
///         smoke plume", Atmos. Environ. 18; frozen turbulence: Taylor 1938.
class DustEddies {
 public:
  static constexpr int kSide = 64;
  static constexpr double kPeriod_m = 9.6;
  static constexpr double kSpread = 1.0;  ///< standard deviation of the factor's logarithm

  DustEddies();
  /// kSide^3 factors, x fastest.
  const std::vector<float>& factors() const { return factors_; }
  /// Interpolated factor at a position shifted back along the wind.
  double At(const Vec3& p_m) const;

 private:
  std::vector<float> factors_;
};

/// Optical extinction of airborne dust.
///
/// Frames  W. Cell (i, j, k) covers the square with lower corner origin_W_m + cell_m (i, j),
///         between cell_m k and cell_m (k + 1) above base_m of its column.
/// Model   extinction is the cells' extinction times the eddies' factor. Cell values are linear
///         between cell centres and fall to zero half a cell beyond them. Below the base (in a pit)
///         the lowest cell's extinction applies.
struct DustVolume {
  Vec2 origin_W_m = Vec2::Zero();
  double cell_m = 1;
  int nx = 0, ny = 0, nz = 0;
  std::vector<float> base_m;                 ///< ground height in W, nx * ny, x fastest
  std::vector<float> extinction_1pm;         ///< nx * ny * nz, x fastest
  std::shared_ptr<const DustEddies> eddies;  ///< null: no eddies
  Vec3 drift_m = Vec3::Zero();               ///< advection of the eddies
  std::uint64_t version = 0;                 ///< grows with each change
  Eigen::AlignedBox3d occupied_W_m;          ///< encloses all dust; empty without dust

  /// Single-scattering albedo by colour, and asymmetry parameter: the mean cosine of the scattering
  /// angle.
  static const Eigen::Vector3f kScattered;
  static constexpr double kAsymmetry = 0.70;
  /// Lidar ratio: extinction over back-scatter per steradian.
  static constexpr double kLidarRatio_sr = 50;

  double Extinction_1pm(const Vec3& p_W_m) const;
};

/// Part of a line within dust, as distances from `origin_W_m`; empty if from >= to.
struct DustySpan {
  double from_m, to_m;
};
DustySpan SpanOf(const DustVolume& dust, const Vec3& origin_W_m, const Vec3& unit_W,
                 double range_m);

/// Step length of ray marching through dust.
inline double MarchStep_m(const DustVolume& dust) { return 0.5 * dust.cell_m; }

/// Integral of the extinction along a line over `range_m`, which may be infinite. `unit_W` has
/// length 1.
double OpticalDepth(const DustVolume& dust, const Vec3& origin_W_m, const Vec3& unit_W,
                    double range_m);

}  // namespace tera
