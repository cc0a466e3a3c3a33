#pragma once

#include <limits>

#include "core/types/effects.h"

namespace tera {

/// Limits of a pump. The defaults are unlimited.
struct PumpFlowParameters {
  double max_flow_m3ps = std::numeric_limits<double>::infinity();
  double max_power_w = std::numeric_limits<double>::infinity();
  double regulator_s = 0;  ///< time constant of the power regulator
};

/// `pump_flow_m3ps` is the full flow of the pump.
PumpFlowParameters PumpFlowOf(const Effects& effects, double pump_flow_m3ps);

/// Slot `flow` of one pump: the delivered share of its demand, equal for all consumers.
///
/// Model   flow_sharing: Q_i = Q_req,i min(1, Q_max / sum Q_req).
///         power_limit: the same with P_max / P. P is the sum of load times rate over the consumers
///         that move against their load. It passes the first-order lag of the regulator. The
///         smaller share applies.
/// Omits   The response of the actuators to their share: the pump limits the demand, so an
///         overshooting actuator_ring takes more than the pump delivers. Priority valves, load
///         sensing, regeneration, the engine's speed.
class PumpFlow {
 public:
  explicit PumpFlow(const PumpFlowParameters& parameters) : parameters_(parameters) {}

  /// True if the share depends on the power.
  bool ReadsPower() const;
  double Step(double requested_m3ps, double requested_w, double dt_s);

 private:
  PumpFlowParameters parameters_;
  double regulated_w_ = 0;
};

}  // namespace tera
