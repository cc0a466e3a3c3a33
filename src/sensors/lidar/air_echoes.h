#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/random.h"
#include "core/types/labels.h"
#include "render/rays/ray_scene.h"
#include "sensors/sampling.h"

namespace tera {

/// What dust and rain do to the pulses of a lidar.
///
/// Model   Relative power of a surface is that of the Lidar times exp(-2 tau), tau the optical
///         depth of dust and rain before it. Dust with extinction s returns as a surface would of
///         reflectance pi (s / S) (c t / 2) exp(-2 tau): S its lidar ratio, c t / 2 = kPulse_m the
///         length of air that answers at one time. A drop of diameter D in the beam returns as pi
///         (pi D^2 / 2 S) / A, A the beam's cross-section there, with the lidar ratio of drops;
///         those that are strong enough to be seen are met as by a Poisson process. Of what is seen
///         of surface, dust and drop, the strongest is the return.
/// Omits   multiple scattering, light that is scattered forward and still arrives, overlap of beam
///         and receiver close by, drops on the window.
/// Source  the lidar equation of volume targets, as in Weitkamp 2005, Lidar, chapter 1; lidar
///         ratios: DustVolume, O'Connor et al. 2004, J. Atmos. Oceanic Technol. 21 (drops, 18 to 19
///         sr); beam: Velodyne VLP-16 user manual, section 4.2 and appendix (9.5 x 12.7 mm, 3.0
///         mrad).
class AirEchoes {
 public:
  static constexpr double kPulse_m = 0.75;  ///< of 5 ns
  static constexpr double kBeam_m = 0.011, kDivergence_rad = 0.003;
  static constexpr double kDropRatio_sr = 18.8;

  /// What a lidar gives a return of.
  struct Limits {
    double min_range_m, max_range_m;
    double least_power;  ///< relative to a head-on unit reflector at 1 m; 0: there is no limit
  };
  /// `draws` tells whether and where drops are met, by the number of the ray.
  AirEchoes(const Limits& limits, const SensedAir& air, const Stream& draws);
  /// Whether there is anything in the air.
  bool any() const { return dust_ != nullptr || extinction_1pm_ > 0; }

  struct Echo {
    double range_m = 0;
    double echo = 0;  ///< reflectance that a head-on surface would have there, in clear air
    SemanticClass label = SemanticClass::kDust;

    double power() const { return echo / (range_m * range_m); }
  };
  struct Passage {
    double two_way = 1;        ///< share of the light that comes back from the end of the ray
    std::optional<Echo> echo;  ///< the strongest on the way, if it is seen
  };
  /// Along a ray of that length.
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
  /// Expected number of drops that are seen nearer than each kDropStep_m.
  std::vector<double> drops_before_;
};

}  // namespace tera
