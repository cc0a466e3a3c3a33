#pragma once

#include <string>
#include <vector>

#include "core/config/model_archive.h"
#include "core/random.h"
#include "core/types/measurement.h"
#include "render/rays/ray_scene.h"
#include "sensors/sampling.h"

namespace tera {

/// Reflectance of the dark target in data sheet ranges.
inline constexpr double kDarkTarget = 0.1;

class AirEchoes;

/// Data-sheet parameters of a spinning multi-beam lidar.
struct LidarModel {
  std::vector<double> elevation_rad;       ///< one per beam (ring), top to bottom
  std::vector<double> azimuth_offset_rad;  ///< one per beam, counter-clockwise from above
  std::vector<double> firing_offset_s;     ///< one per beam, less than a column's duration
  int columns = 1024;                      ///< firings per revolution
  bool clockwise = true;                   ///< seen from above
  double min_range_m = 0.3, max_range_m = 120;
  double range_noise_m = 0;          ///< 1 sigma at strong return
  double range_at_10_percent_m = 0;  ///< data sheet's range on a 10 % target; 0: no power limit
};

void Serialize(ModelArchive* archive, LidarModel* model);

/// Spinning multi-beam lidar.
///
/// Frames  W world; S sensor, x forward, y left, z up. Ray k leaves p_WS(t_k) along R_WS(t_k)
///         d_S,k. A revolution starts at -x, so that its seam lies behind.
/// Model   each ray has its own time and pose. The relative power is rho cos(theta) / r^2; a return
///         needs at least the power of a 10 % target at `range_at_10_percent_m`. Range is r + N(0,
///         sigma^2); ray i of revolution k draws its noise at index k * rays + i. Intensity is rho
///         cos(theta). Dust and rain weaken returns and produce their own (AirEchoes).
/// Omits   beam divergence at surfaces, multiple returns, noise growth at weak power, crosstalk,
///         fog; points for rays without a return.
/// Source  the radar equation for a target that fills the beam and scatters diffusely, as in Wagner
///         et al. 2006, "Gaussian decomposition and calibration of a novel small-footprint
///         full-waveform digitising airborne laser scanner"; each preset names its data sheet.
class Lidar {
 public:
  /// Lowest rate at which LidarPoint::time_offset_ns holds all offsets of a revolution: 2^32 ns are
  /// 4.29 s.
  static constexpr double kSlowest_hz = 0.25;
  /// Recommended number of body poses per revolution; the ray scene interpolates between them.
  static constexpr int kScenePoses = 11;

  Lidar(const LidarModel& model, const SampleClock& clock, TimeNs latency_ns, std::uint64_t seed,
        const std::string& stream_name);
  /// Revolution k, from clock.Due(k) to clock.Due(k + 1). `scene` must have been updated over
  /// exactly that interval, and `X_WS` must cover it. A scan is available `latency_ns` after the
  /// end of its revolution. The result does not depend on the number of `threads`.
  LidarScan Measure(std::int64_t k, const PoseTrack& X_WS, const RayScene& scene, int threads,
                    const SensedAir& air = {}) const;

 private:
  struct Block;
  void Aim(std::int64_t k, int begin, int end, const PoseTrack& X_WS, Block* block) const;
  static double Through(const AirEchoes& air, const Ray& ray, std::uint64_t number, double echo,
                        RayHit* hit);
  void Detect(std::int64_t k, int begin, const AirEchoes& air, const Block& block,
              std::vector<LidarPoint>* points) const;

  /// A beam in the head frame H at the start of its column.
  struct Beam {
    Vec3 d_H;
    TimeNs offset_ns;
  };

  LidarModel model_;
  SampleClock clock_;
  TimeNs latency_ns_;
  Stream range_noise_, air_draws_;
  std::vector<Beam> beams_;
};

}  // namespace tera
