#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/config/model_archive.h"
#include "core/random.h"
#include "core/types/measurement.h"
#include "render/rays/ray_scene.h"
#include "sensors/lidar/pulse_train.h"
#include "sensors/lidar/range_equation.h"
#include "sensors/lidar/scan_pattern.h"
#include "sensors/sampling.h"

namespace tera {

class AirEchoes;

/// Data-sheet parameters of a lidar with a spinning head of several beams, or of one beam with a
/// pattern of its own.
struct LidarModel {
  std::vector<double> elevation_rad;       ///< one per beam (ring), top to bottom
  std::vector<double> azimuth_offset_rad;  ///< one per beam, counter-clockwise from above
  std::vector<double> firing_offset_s;     ///< one per beam, less than a column's duration
  int columns = 1024;                      ///< firings per revolution, or pulses per scan
  std::optional<ScanPattern> pattern;      ///< none: a spinning head
  bool clockwise = true;                   ///< seen from above
  double min_range_m = 0.3, max_range_m = 120;
  double range_noise_m = 0;          ///< 1 sigma at strong return
  double range_at_10_percent_m = 0;  ///< data sheet's range on a 10 % target; 0: no power limit
  std::optional<double> range_at_80_percent_m;
  std::optional<double> range_noise_at_limit_m;  ///< 1 sigma at the weakest detected return
  std::optional<LidarBeam> beam;                 ///< none: a thin ray
};

void Serialize(ModelArchive* archive, LidarModel* model);

/// Pulsed lidar, with a spinning head or a pattern.
///
/// Frames  W world; S sensor, x forward, y left, z up. Ray k leaves p_WS(t_k) along R_WS(t_k)
///         d_S,k. A revolution starts at -x, so that its seam lies behind. A pattern goes on from
///         scan to scan; a scan is as long as a revolution.
/// Model   each pulse has its own time and pose. Power and threshold are RangeEquation's, and
///         the air is that of AirEchoes. A thin ray reports its strongest echo. A beam has a
///         Gaussian profile and is sampled by seven rays. Its axis has half of the energy, six
///         others a twelfth each. These lie at the angle w = D / sqrt(2 ln 2) of 1/e^2 of the
///         intensity, with D the full angle at half power. This is exact for fields up to the fifth
///         degree across the beam. Its echoes add up (FindPeaks); peaks above the threshold are
///         returns, in the order of `pick`. Range is r + N(0, s0^2 + s1^2 P_least / P), with the
///         deviations s0 of strong and s1 of barely detected returns. Pulse i of revolution k draws
///         at index k * pulses + i, its second return in the next lane. Intensity is rho cos(theta)
///         exp(-2 tau) of what a peak shows.
/// Omits   retroreflectors, mirrors, crosstalk, detections of noise alone, elliptical beams; points
///         for pulses without a return.
/// Source  quadrature: Stroud 1971, "Approximate calculation of multiple integrals", E_2^{r^2} 5-1;
///         noise: the deviation falls as the root of signal to noise, as in Kilic et al. 2021,
///         "Lidar light scattering augmentation (LISA)", eq. 6. Each preset names its data sheet.
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
  struct Return;
  struct Block;
  Mat3 HeadAt(std::int64_t k, int column) const;
  void Aim(std::int64_t k, int begin, int end, const PoseTrack& X_WS, Block* block) const;
  /// Computes the returns of pulse i of a block, in the order in which the lidar reports them.
  /// `number` is the number of the pulse in its random streams.
  void Receive(std::size_t i, std::uint64_t number, const AirEchoes& air, Block* block) const;
  static void Pick(const std::optional<LidarBeam>& beam, std::vector<Return>* returns);
  double RangeSigma_m(double range_m, double reflectance) const;
  void Detect(std::int64_t k, int begin, const AirEchoes& air, Block* block,
              std::vector<LidarPoint>* points) const;

  /// Directions of a beam in the head frame H at the start of its column: first its axis, then its
  /// other sub-rays.
  struct Beam {
    std::vector<Vec3> d_H;
    TimeNs offset_ns;
  };

  LidarModel model_;
  RangeEquation equation_;
  double pulse_m_;            ///< length of the pulse's full width in range
  std::size_t sub_rays_ = 1;  ///< per beam
  SampleClock clock_;
  TimeNs latency_ns_;
  Stream range_noise_, air_draws_;
  std::vector<Beam> beams_;
};

}  // namespace tera
