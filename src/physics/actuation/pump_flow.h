#pragma once

#include <limits>

#include "core/types/effects.h"

namespace tera {

/// What a pump can deliver. As built, everything.
struct PumpFlowParameters {
  double max_flow_m3ps = std::numeric_limits<double>::infinity();
  double max_power_w = std::numeric_limits<double>::infinity();
  double regulator_s = 0;  ///< time constant with which the pump yields to power
};

/// `pump_flow_m3ps` is the pump's full flow.
PumpFlowParameters PumpFlowOf(const Effects& effects, double pump_flow_m3ps);

/// Slot `flow` of one pump: the share of what is asked of it that it delivers, the same to all.
///
/// Model   flow_sharing: Q_i = Q_req,i min(1, Q_max / sum Q_req). power_limit: the same with
///         P_max / P, where P sums load times rate over all that draw from the pump and move
///         against their load, seen through the regulator's first-order lag. The smaller share
///         holds.
/// Omits   what actuators behind it make of their share: it is the demand that is shared, and an
///         actuator_ring takes more than the pump gives for as long as it overshoots. Priority
///         valves, load sensing, regeneration, the engine's speed.
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
