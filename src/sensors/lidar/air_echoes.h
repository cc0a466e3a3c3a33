#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/random.h"
#include "core/types/labels.h"
#include "render/rays/ray_scene.h"
#include "sensors/sampling.h"

namespace tera {

/// Effect of dust and rain on lidar pulses.
///
/// Model   a surface's relative power is the Lidar's times exp(-2 tau), where tau is the optical
///         depth of dust and rain in front of it. Dust of extinction s back-scatters like a surface
///         of reflectance pi (s / S) (c t / 2) exp(-2 tau). S is its lidar ratio;
///         c t / 2 = kPulse_m is the depth of air that one pulse covers. A drop of diameter D in
///         the beam returns as pi (pi D^2 / 2 S) / A, with the lidar ratio of drops and the beam's
///         cross-section A. Detectable drops follow a Poisson process along the ray. The strongest
///         detectable echo of surface, dust and drop is the return.
/// Omits   multiple scattering, forward-scattered light that still arrives, overlap of beam and
///         receiver at close range, drops on the window.
/// Source  the lidar equation of volume targets, as in Weitkamp 2005, Lidar, chapter 1; lidar
///         ratios: DustVolume, O'Connor et al. 2004, J. Atmos. Oceanic Technol. 21 (drops, 18 to 19
///         sr); beam: Velodyne VLP-16 user manual, section 4.2 and appendix (9.5 x 12.7 mm, 3.0
///         mrad).
class AirEchoes {
 public:
  static constexpr double kPulse_m = 0.75;  ///< for a pulse of 5 ns
  static constexpr double kBeam_m = 0.011, kDivergence_rad = 0.003;
  static constexpr double kDropRatio_sr = 18.8;

  /// Detection limits of a lidar.
  struct Limits {
    double min_range_m, max_range_m;
    double least_power;  ///< relative to a head-on unit reflector at 1 m; 0: no limit
  };
  /// `draws` determines the drops on a ray, by the ray's number.
  AirEchoes(const Limits& limits, const SensedAir& air, const Stream& draws);
  /// True if the air contains dust or rain.
  bool any() const { return dust_ != nullptr || extinction_1pm_ > 0; }

  struct Echo {
    double range_m = 0;
    double echo = 0;  ///< equivalent reflectance of a head-on surface in clear air
    SemanticClass label = SemanticClass::kDust;

    double power() const { return echo / (range_m * range_m); }
  };
  struct Passage {
    double two_way = 1;        ///< two-way transmittance to the end of the ray
    std::optional<Echo> echo;  ///< strongest detectable echo along the ray
  };
  /// Effects along a ray of length `range_m`.
  Passage Along(const Ray& ray, double range_m, std::uint64_t number) const;

 private:
  void FindDrops();
  double LeastDrop_m(double range_m) const;
  static double BeamArea_m2(double range_m);
  void MeetDust(const Ray& ray, double range_m, std::uint64_t number, Passage* passage) const;
  void MeetDrop(const Ray& ray, double range_m, std::uint64_t number, Passage* passage) const;

  const DustVolume* dust_;
  double rain_mmph_, extinction_1pm_ = 0;
  Limits limits_;
  const Stream& draws_;
  /// Expected number of detectable drops below each multiple of kDropStep_m.
  std::vector<double> drops_before_;
};

}  // namespace tera
