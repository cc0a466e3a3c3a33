#pragma once

#include <cmath>
#include <string>

#include "core/random.h"
#include "core/time.h"
#include "core/types/effects.h"
#include "sensors/slots/effect_numbers.h"

/// Parts that the static errors of several sensors share. Each is exact where its mechanism is
/// absent.

namespace tera {

/// Nearest multiple of `step`; 0: unchanged.
inline double Quantised(double value, double step) {
  return step > 0 ? step * std::round(value / step) : value;
}

/// How much warmer a sensor is than when it was calibrated, `temperature_drift`.
///
/// Model   dT(t) = `warm_up_k` (1 - e^(-t / `time_constant_s`)), t since the start.
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

/// Which measurements are wild, `outliers`: each with the same probability, independently.
class OutlierDraw {
 public:
  OutlierDraw(const Effects& effects, std::uint64_t seed, const std::string& stream_name)
      : stream_(seed, stream_name + "/outliers"),
        probability_(NumberOf(effects, "outliers", "probability", 0)) {}

  /// Whether the measurement of that index is one.
  bool At(std::uint64_t index) const {
    return probability_ > 0 && stream_.Uniform(index) < probability_;
  }
  /// Its errors, standard normal; lanes 0 are taken by the draw itself.
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
