#pragma once

#include <cmath>
#include <string>

#include "core/random.h"
#include "core/time.h"
#include "core/types/effects.h"
#include "sensors/slots/effect_numbers.h"

/// Static errors common to several sensors. Without its mechanism, an error is exactly zero.

namespace tera {

/// Nearest multiple of `step`; a step of 0 leaves the value unchanged.
inline double Quantised(double value, double step) {
  return step > 0 ? step * std::round(value / step) : value;
}

/// Temperature of a sensor above that of its calibration, `temperature_drift`.
struct WarmUp {
  double warm_up_k = 0, time_constant_s = 1;

  static WarmUp Of(const Effects& effects) {
    return {NumberOf(effects, "temperature_drift", "warm_up_k", 0),
            NumberOf(effects, "temperature_drift", "time_constant_s", 1)};
  }
  double At(TimeNs t_ns) const {
    return -warm_up_k * std::expm1(-ToSeconds(t_ns) / time_constant_s);
  }
};

/// Selection of outliers, `outliers`: independent, with constant probability per measurement.
class OutlierDraw {
 public:
  OutlierDraw(const Effects& effects, std::uint64_t seed, const std::string& stream_name)
      : stream_(seed, stream_name + "/outliers"),
        probability_(NumberOf(effects, "outliers", "probability", 0)) {}

  /// True if the measurement with this index is an outlier.
  bool At(std::uint64_t index) const {
    return probability_ > 0 && stream_.Uniform(index) < probability_;
  }
  /// Standard normal errors. Lane 0 is reserved for the selection of outliers.
  double Gaussian(std::uint64_t index, std::uint32_t lane = 1) const {
    return stream_.Gaussian(index, lane);
  }
  Vec3 Gaussian3(std::uint64_t index, std::uint32_t lane = 1) const {
    return stream_.Gaussian3(index, lane);
  }

 private:
  Stream stream_;
  double probability_;
};

}  // namespace tera
