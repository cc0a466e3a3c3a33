#pragma once

#include <limits>

#include "core/types/effects.h"

namespace tera {

/// Limits of a pump. The defaults are none.
struct PumpFlowParameters {
  double max_flow_m3ps = std::numeric_limits<double>::infinity();
  double max_power_w = std::numeric_limits<double>::infinity();
  double regulator_s = 0;  ///< time constant of the power regulator
};

/// `pump_flow_m3ps` is the pump's full flow.
PumpFlowParameters PumpFlowOf(const Effects& effects, double pump_flow_m3ps);

/// Slot `flow` of one pump: the delivered share of its demand, equal for all consumers.
///
/// Model   flow_sharing: Q_i = Q_req,i min(1, Q_max / sum Q_req).
///         power_limit: the same with P_max / P. P sums load times rate over the pump's consumers
///         that move against their load, seen through the regulator's first-order lag.
///         The smaller share holds.
/// Omits   the actuators' response to their share: the pump limits the demand, and an overshooting
///         actuator_ring takes more than the pump gives. Priority valves, load sensing,
///         regeneration, the engine's speed.
class PumpFlow {
 public:
  explicit PumpFlow(const PumpFlowParameters& parameters) : parameters_(parameters) {}

  /// Whether the share depends on the power.
  bool ReadsPower() const;
  double Step(double requested_m3ps, double requested_w, double dt_s);

 private:
  PumpFlowParameters parameters_;
  double regulated_w_ = 0;
};

}  // namespace tera
