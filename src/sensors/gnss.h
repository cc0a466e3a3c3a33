#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/config/config.h"
#include "core/random.h"
#include "core/types/measurement.h"

namespace tera {

/// Where the world lies on Earth.
///
/// Frames  W local east-north-up: its origin at the geodetic place, z along the ellipsoid's normal
///         there. Geodetic: WGS 84, degrees, height above the ellipsoid.
/// Model   W to Earth-centred Cartesian by one rigid motion, then to geodetic: a plane, so that the
///         ellipsoid falls away from z = 0 by d^2 / 2R, 8 cm at 1 km.
/// Omits   the geoid, tides, plate motion.
/// Source  GeographicLib's LocalCartesian; Karney 2011, "Geodesics on an ellipsoid of revolution",
///         appendix B.
class SiteFrame {
 public:
  SiteFrame(double lat_deg, double lon_deg, double height_m);
  ~SiteFrame();
  SiteFrame(SiteFrame&&) noexcept;
  struct Geodetic {
    double lat_deg, lon_deg, height_m;
  };
  Geodetic ToGeodetic(const Vec3& p_W_m) const;
  Vec3 ToEnu(const Geodetic& place) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Error of a receiver along the axes of W: first-order Gauss-Markov plus white, vertical apart.
struct GnssModel {
  double white_horizontal_m = 0, white_vertical_m = 0;            ///< 1 sigma
  double correlated_horizontal_m = 0, correlated_vertical_m = 0;  ///< 1 sigma, stationary
  double correlation_time_s = 60;
  Vec3 bias_enu_m = Vec3::Zero();  ///< constant, not in the reported variance
  GnssFix fix = GnssFix::kRtkFixed;
};

/// As written in YAML: "none", "single", "rtk_fixed", "rtk_float".
std::string_view NameOf(GnssFix fix);

GnssModel ReadGnssModel(const ConfigMap& config);

/// One antenna and its receiver.
///
/// Frames  W world (local east-north-up), S the antenna; `enu_m` of a sample is p_WS as measured.
/// Model   p = p_WS + b + c_k + n_k; c_k = e^(-T/tau) c_(k-1) + sqrt(1 - e^(-2T/tau)) sigma_c w_k.
///         The variance reported is sigma_c^2 + sigma_n^2, without the bias.
/// Omits   satellites, masking. (Multipath and lost ambiguities, in their simplest forms:
///         GnssErrors.)
/// Source  first-order Gauss-Markov process: Gelb 1974, "Applied optimal estimation", ch. 3.
class Gnss {
 public:
  Gnss(const GnssModel& model, const SampleClock& clock, TimeNs latency_ns, std::uint64_t seed,
       const std::string& stream_name);
  /// Sample k (called for k = 0, 1, 2, ... in order) with the antenna at `p_WS_m`.
  GnssSample Measure(std::int64_t k, const Vec3& p_WS_m, const SiteFrame& site);

 private:
  GnssModel model_;
  SampleClock clock_;
  TimeNs latency_ns_;
  Stream white_, correlated_;
  Vec3 correlated_enu_m_ = Vec3::Zero();
  std::int64_t next_ = 0;
};

}  // namespace tera
