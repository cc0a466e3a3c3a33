#include "physics/actuation/pump_flow.h"

#include <algorithm>
#include <cmath>

namespace tera {

PumpFlowParameters PumpFlowOf(const Effects& effects, double pump_flow_m3ps) {
  PumpFlowParameters parameters;
  if (const Effect* sharing = FindEffect(effects, "flow_sharing")) {
    parameters.max_flow_m3ps = pump_flow_m3ps * (*sharing)["capacity"];
  }
  if (const Effect* limit = FindEffect(effects, "power_limit")) {
    parameters.max_power_w = (*limit)["power_w"];
    parameters.regulator_s = (*limit)["regulator_s"];
  }
  return parameters;
}

bool PumpFlow::ReadsPower() const { return std::isfinite(parameters_.max_power_w); }

double PumpFlow::Step(double requested_m3ps, double requested_w, double dt_s) {
  double share = 1;
  if (requested_m3ps > parameters_.max_flow_m3ps) {
    share = parameters_.max_flow_m3ps / requested_m3ps;
  }
  const double step =
      parameters_.regulator_s > 0 ? -std::expm1(-dt_s / parameters_.regulator_s) : 1.0;
  regulated_w_ += step * (requested_w - regulated_w_);
  if (regulated_w_ > parameters_.max_power_w) {
    share = std::min(share, parameters_.max_power_w / regulated_w_);
  }
  return share;
}

}  // namespace tera
