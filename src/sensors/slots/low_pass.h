#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/time.h"
#include "core/types/effects.h"

namespace tera {

/// Filter inside a sensor, `filter_delay`, over all numbers of a measurement alike.
///
/// Model   first-order low-pass, y_k = y_(k-1) + (1 - e^(-T / tau)) (x_k - y_(k-1)): exact for an
///         input that holds its value over the interval T before its sample. y_0 = x_0. A ramp
///         comes out late by tau - T / 2 and a little, by tau where T is short.
/// Omits   filters of higher order.
class LowPass {
 public:
  /// 0: none, what comes in goes out.
  explicit LowPass(double time_constant_s) : time_constant_s_(time_constant_s) {}
  explicit LowPass(const Effects& effects);
  bool present() const { return time_constant_s_ > 0; }
  /// What comes out for input `x` at `t_ns`; sizes stay, times grow.
  const Eigen::VectorXd& Next(TimeNs t_ns, const Eigen::VectorXd& x);

 private:
  double time_constant_s_;
  std::optional<TimeNs> last_ns_;
  Eigen::VectorXd y_;
};

}  // namespace tera
