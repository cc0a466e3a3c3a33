#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Whirls of the air that are smaller than the cells of a dust cloud: a factor of its density.
///
/// Model   log-normal, of mean 1, periodic along each axis, carried along by the wind as a whole
///         (frozen turbulence). Of octaves whose amplitude falls as the cube root of their size,
///         from a quarter of the period down, as in the inertial range.
/// Omits   whirls that change while they are carried along.
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
  /// Between them, at a place that has been carried back by the wind.
  double At(const Vec3& p_m) const;

 private:
  std::vector<float> factors_;
};

/// The dust in the air as light meets it: how much of it is lost for each metre.
///
/// Frames  W. Cell (i, j, k) stands over the square from origin_W_m + cell_m (i, j) on, between
///         cell_m k and cell_m (k + 1) above base_m of its column.
/// Model   extinction is that of the cells, linear between their middles and falling to nothing
///         half a cell beyond them, times that of the eddies. Below the base (in a pit) the air is
///         as the lowest cell's.
struct DustVolume {
  Vec2 origin_W_m = Vec2::Zero();
  double cell_m = 1;
  int nx = 0, ny = 0, nz = 0;
  std::vector<float> base_m;                 ///< height of the ground in W, nx * ny, x fastest
  std::vector<float> extinction_1pm;         ///< nx * ny * nz, x fastest
  std::shared_ptr<const DustEddies> eddies;  ///< null: none
  Vec3 drift_m = Vec3::Zero();               ///< by which the eddies have been carried
  std::uint64_t version = 0;                 ///< grows with each change
  Eigen::AlignedBox3d occupied_W_m;          ///< all dust lies within; empty where there is none

  /// Share of the extinguished light that is scattered, by colour, and the mean cosine of the angle
  /// that it is scattered by.
  static const Eigen::Vector3f kScattered;
  static constexpr double kAsymmetry = 0.70;
  /// Extinction over what is scattered straight back for each steradian.
  static constexpr double kLidarRatio_sr = 50;

  double Extinction_1pm(const Vec3& p_W_m) const;
};

/// Part of a line that has dust: distances along it from `origin_W_m`, none where from >= to.
struct DustySpan {
  double from_m, to_m;
};
DustySpan SpanOf(const DustVolume& dust, const Vec3& origin_W_m, const Vec3& unit_W,
                 double range_m);

/// Length of the steps in which lines are followed through dust.
inline double MarchStep_m(const DustVolume& dust) { return 0.5 * dust.cell_m; }

/// Integral of the extinction along a line, `unit_W` of length 1, over `range_m`, which may be
/// infinite.
double OpticalDepth(const DustVolume& dust, const Vec3& origin_W_m, const Vec3& unit_W,
                    double range_m);

}  // namespace tera
