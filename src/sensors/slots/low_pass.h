#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/time.h"
#include "core/types/effects.h"

namespace tera {

/// Filter inside a sensor, `filter_delay`, applied equally to all values of a measurement.
///
/// Model   First-order low pass, y_k = y_(k-1) + (1 - e^(-T / tau)) (x_k - y_(k-1)), y_0 = x_0. It
///         is exact for an input that is constant over the interval T before its sample. A ramp
///         lags by about tau - T / 2, and by tau for short T.
/// Omits   Filters of higher order.
class LowPass {
 public:
  /// 0 disables the filter.
  explicit LowPass(double time_constant_s) : time_constant_s_(time_constant_s) {}
  explicit LowPass(const Effects& effects);
  bool present() const { return time_constant_s_ > 0; }
  /// Output for input `x` at `t_ns`. The size of `x` is constant and times increase.
  const Eigen::VectorXd& Next(TimeNs t_ns, const Eigen::VectorXd& x);

 private:
  double time_constant_s_;
  std::optional<TimeNs> last_ns_;
  Eigen::VectorXd y_;
};

}  // namespace tera
