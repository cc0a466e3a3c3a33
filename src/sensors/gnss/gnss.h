#pragma once

#include <string>
#include <string_view>

#include "core/config/model_archive.h"
#include "core/random.h"
#include "core/types/measurement.h"
#include "dataset/format/site_frame.h"

namespace tera {

/// Receiver error along the axes of W: first-order Gauss-Markov plus white noise, separate for the
/// vertical.
struct GnssModel {
  double white_horizontal_m = 0, white_vertical_m = 0;            ///< 1 sigma
  double correlated_horizontal_m = 0, correlated_vertical_m = 0;  ///< 1 sigma, stationary
  double correlation_time_s = 60;
  Vec3 bias_enu_m = Vec3::Zero();  ///< constant, excluded from the reported variance
  GnssFix fix = GnssFix::kRtkFixed;
};

/// Name of a fix in YAML: "none", "single", "differential", "rtk_fixed", "rtk_float".
std::string_view NameOf(GnssFix fix);

void Serialize(ModelArchive* archive, GnssModel* model);

/// One GNSS antenna with its receiver.
///
/// Frames  W world (local east-north-up), S the antenna; `enu_m` of a sample is the measured p_WS.
/// Model   p = p_WS + b + c_k + n_k, with c_k = e^(-T/tau) c_(k-1) + sqrt(1 - e^(-2T/tau)) sigma_c
///         w_k. The reported variance is sigma_c^2 + sigma_n^2, without the bias.
/// Omits   Satellites, masking. GnssErrors adds simple forms of multipath and of lost ambiguities.
/// Source  First-order Gauss-Markov process: Gelb 1974, "Applied optimal estimation", ch. 3.
class Gnss {
 public:
  Gnss(const GnssModel& model, const SampleClock& clock, TimeNs latency_ns, std::uint64_t seed,
       const std::string& stream_name);
  /// Sample k with the antenna at `p_WS_m`. Call it for k = 0, 1, 2, ...
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
