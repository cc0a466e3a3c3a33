#pragma once

#include <optional>
#include <string>

#include "core/config/model_archive.h"

namespace tera {

struct LidarModel;

/// Reflectances of the targets in data sheet ranges.
inline constexpr double kDarkTarget = 0.1, kBrightTarget = 0.8;

/// A lidar's beam with a width, and what its receiver reports of a pulse.
struct LidarBeam {
  double divergence_rad = 0;       ///< full angle between the points of half power
  double aperture_m = 0.011;       ///< diameter of beam and receiver at the lidar
  int sub_rays = 7;                ///< rays that sample the beam: 1 or 7
  double pulse_s = 5e-9;           ///< full width at half power
  int returns = 1;                 ///< most points of one pulse, 1 to 3
  std::string pick = "strongest";  ///< which echo comes first: strongest, first or last
};

void Serialize(ModelArchive* archive, LidarBeam* beam);

/// Power of a lidar's echoes, and the least power that it detects, in clear air.
///
/// Model   a diffuse surface of reflectance rho returns P = rho cos(theta) O(r) / r^2 relative to a
///         head-on white surface at 1 m. A point at range r is out of focus, and its light spreads
///         over d + D r, the beam's diameter there, instead of D r: O = (D r / (d + D r))^2, with
///         the aperture d and the divergence D. Then P = rho cos(theta) / (r + d / D)^2. A return
///         needs the power of a 10 % target at its range in the data sheet. Beyond that range the
///         required reflectance is a power law of r. It passes through the 80 % target at its range
///         in the data sheet. Without `beam` a surface has O = 1.
/// Omits   separate axes of beam and receiver.
/// Source  the radar equation for a target that fills the beam and scatters diffusely, as in Wagner
///         et al. 2006, "Gaussian decomposition and calibration of a novel small-footprint
///         full-waveform digitising airborne laser scanner"; overlap of a receiver focused at
///         infinity: Weitkamp 2005, Lidar, section 1.3.2.
class RangeEquation {
 public:
  explicit RangeEquation(const LidarModel& model);

  /// False if the data sheet states no range. Then every surface is detected, and fog, rain and
  /// snow never are.
  bool limits() const { return dark_range_m_ > 0; }
  /// Least reflectance at which a surface perpendicular to the beam is detected at this range.
  double LeastSurface(double range_m) const { return Least(range_m, surface_near_m_); }
  /// The same of matter in the air.
  double LeastAir(double range_m) const { return Least(range_m, near_m_); }
  /// Range up to which a surface of that reflectance is detected; infinite without a limit.
  double Reach_m(double reflectance) const;
  /// Power from a surface of this reflectance perpendicular to the beam.
  double Power(double reflectance, double range_m) const {
    const double r_m = range_m + near_m_;
    return reflectance / (r_m * r_m);
  }
  /// Reflectance of a surface perpendicular to the beam that returns this power.
  double Reflectance(double power, double range_m) const {
    const double r_m = range_m + near_m_;
    return power * r_m * r_m;
  }
  /// Power of the weakest detected echo within the dark target's range.
  double LeastPower() const { return Power(kDarkTarget, dark_range_m_); }
  double BeamArea_m2(double range_m) const;

 private:
  double Least(double range_m, double near_m) const;

  double aperture_m_, divergence_rad_;
  double near_m_;          ///< d / D
  double surface_near_m_;  ///< the same; 0 without a beam
  double dark_range_m_ = 0, bright_exponent_ = 2;
};

}  // namespace tera
