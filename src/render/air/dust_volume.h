#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Turbulent fluctuations of the dust density that are finer than the cells of a dust cloud. They
/// are a factor on the density.
///
/// Model   the factor is log-normal with mean 1 and periodic along each axis. The wind carries the
///         whole pattern without changing it (frozen turbulence). The logarithm is a sum of noise
///         octaves. The largest wavelength is a quarter of the period. The amplitude of an octave
///         is proportional to the cube root of its wavelength, as in the inertial range.
/// Omits   evolution of eddies while the wind carries them.
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
  /// Factor at a position in the pattern's own frame, interpolated. The caller subtracts the wind's
  /// displacement from the position.
  double At(const Vec3& p_m) const;

 private:
  std::vector<float> factors_;
};

/// Optical extinction of airborne dust, on a grid of cells.
///
/// Frames  W. Cell (i, j, k) covers the square with lower corner origin_W_m + cell_m (i, j). It
///         lies between the heights cell_m k and cell_m (k + 1) above its column's base_m.
/// Model   the extinction is the interpolated extinction of the cells times the factor of the
///         eddies. Interpolation is linear between cell centres; values fall to zero half a cell
///         beyond the outermost centres. Below base_m (in a pit) the extinction of the lowest cell
///         applies.
struct DustVolume {
  Vec2 origin_W_m = Vec2::Zero();
  double cell_m = 1;
  int nx = 0, ny = 0, nz = 0;
  std::vector<float> base_m;                 ///< ground height in W, nx * ny, x fastest
  std::vector<float> extinction_1pm;         ///< nx * ny * nz, x fastest
  std::shared_ptr<const DustEddies> eddies;  ///< null: no eddies
  Vec3 drift_m = Vec3::Zero();               ///< displacement of the eddies by the wind
  std::uint64_t version = 0;                 ///< increases with each change
  Eigen::AlignedBox3d occupied_W_m;          ///< encloses all dust; empty without dust

  /// Single-scattering albedo (scattered share of the extinction) by colour channel, and the
  /// asymmetry parameter (mean cosine of the scattering angle).
  static const Eigen::Vector3f kScattered;
  static constexpr double kAsymmetry = 0.70;
  /// Ratio of extinction to back-scatter per steradian.
  static constexpr double kLidarRatio_sr = 50;

  double Extinction_1pm(const Vec3& p_W_m) const;
};

/// The part of a line that can contain dust, as distances from `origin_W_m`. Empty if from_m >=
/// to_m.
struct DustySpan {
  double from_m, to_m;
};
DustySpan SpanOf(const DustVolume& dust, const Vec3& origin_W_m, const Vec3& unit_W,
                 double range_m);

/// Step length of ray marching through dust.
inline double MarchStep_m(const DustVolume& dust) { return 0.5 * dust.cell_m; }

/// Integral of the extinction along a line, from `origin_W_m` to `range_m`, which may be infinite.
/// `unit_W` is a unit vector.
double OpticalDepth(const DustVolume& dust, const Vec3& origin_W_m, const Vec3& unit_W,
                    double range_m);

}  // namespace tera
