#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/random.h"
#include "render/air/rain.h"
#include "render/rays/ray_scene.h"
#include "sensors/lidar/pulse_train.h"
#include "sensors/lidar/range_equation.h"
#include "sensors/sampling.h"

namespace tera {

/// Length of air that one pulse covers. Without a `beam` it is the length of a typical pulse.
double PulseLength_m(const std::optional<LidarBeam>& beam);

/// Effect of the air on lidar pulses: fog, rain, falling snow and dust.
///
/// Model   a surface's power is RangeEquation's times exp(-2 tau), where tau is the optical depth
///         in front of it. Air with back-scatter b per metre and steradian returns like a surface
///         of reflectance pi b (c t / 2) exp(-2 tau). c t / 2 is the length of air within one
///         pulse. Fog is sampled once a pulse length. Each sample has the receiver's noise, 1 /
///         kThresholdToNoise of the threshold, and the strongest is the echo. A drop or flake in
///         the beam's cross-section A returns as pi (pi (s D)^2 / 2 S) / A, with its swollen
///         diameter s D and lidar ratio S. Detectable drops and flakes follow a Poisson process
///         along the ray; the nearest drop and the nearest flake are echoes.
/// Omits   multiple scattering, forward-scattered light that still arrives, drops on the window.
/// Source  the lidar equation of volume targets: Weitkamp 2005, Lidar, chapter 1; lidar ratios:
///         DustVolume, Rain, Snowfall; fog: FogBackscatter_1pmsr. The ratio of threshold to noise:
///         one false alarm in 10 000 pulses of 200 range cells (Ouster OS1 data sheet).
class AirEchoes {
 public:
  static constexpr double kThresholdToNoise = 4.9;

  struct Ranges {
    double min_m, max_m;
    double pulse_m;  ///< length of air that one pulse covers
  };
  /// `draws` determines the echoes of a ray, by the ray's number.
  AirEchoes(const RangeEquation& equation, const Ranges& ranges, const SensedAir& air,
            const Stream& draws);
  /// True if the air changes echoes.
  bool any() const { return dust_ != nullptr || extinction_1pm_ > 0; }

  /// Two-way transmittance over `range_m` of a ray.
  double TwoWay(const Ray& ray, double range_m) const;
  /// Adds the detectable echoes along a ray of length `range_m`.
  void Add(const Ray& ray, double range_m, std::uint64_t number, std::vector<Echo>* echoes) const;

 private:
  /// Drops or flakes.
  struct Falling {
    FallingParticles sizes;
    double ratio_sr;
    std::uint32_t lane;  ///< first of its lanes of random draws
    /// Expected number of detectable particles below each multiple of kStep_m.
    std::vector<double> before;
  };
  void Meet(FallingParticles sizes, double ratio_sr, std::uint32_t lane);
  double LeastDiameter_m(const Falling& falling, double range_m) const;
  void AddDust(const Ray& ray, double range_m, std::uint64_t number,
               std::vector<Echo>* echoes) const;
  void AddFog(const Ray& ray, double range_m, std::uint64_t number,
              std::vector<Echo>* echoes) const;
  void AddParticle(const Falling& falling, const Ray& ray, double range_m, std::uint64_t number,
                   std::vector<Echo>* echoes) const;
  double DustDepth(const Ray& ray, double range_m) const;

  RangeEquation equation_;
  Ranges ranges_;
  const DustVolume* dust_;
  const Stream& draws_;
  double extinction_1pm_ = 0;   ///< of all but dust
  double fog_reflectance_ = 0;  ///< reflectance of one pulse length of fog
  std::vector<Falling> falling_;
};

}  // namespace tera
