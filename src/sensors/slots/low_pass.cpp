#include "sensors/slots/low_pass.h"

#include <cmath>

#include "sensors/slots/effect_numbers.h"

namespace tera {

LowPass::LowPass(const Effects& effects)
    : time_constant_s_(NumberOf(effects, "filter_delay", "time_constant_s", 0)) {}

const Eigen::VectorXd& LowPass::Next(TimeNs t_ns, const Eigen::VectorXd& x) {
  if (last_ns_) {
    y_ -= std::expm1(-ToSeconds(t_ns - *last_ns_) / time_constant_s_) * (x - y_);
  } else {
    y_ = x;
  }
  last_ns_ = t_ns;
  return y_;
}

}  // namespace tera
