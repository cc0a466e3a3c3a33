#pragma once

#include <optional>
#include <vector>

#include "core/types/effects.h"
#include "diagnose/replay/axis_log.h"
#include "physics/actuation/pump_flow.h"
#include "physics/description/machine.h"

namespace tera {

/// Demand on the pump that feeds one axis, at each step of a log.
///
/// Model   Each other function of the pump demands the response of its own chain to its recorded
///         lever, with the model's effects. The axis takes oil in proportion to its rate and its
///         displacement at the measured position.
/// Omits   Axes that several pumps feed; the effect of an axis's own `cylinder_lever` on oil and
///         power.
/// Source  As flow_sharing (docs/reference/mechanisms.md): Djurovic and Helduser 2004, "New control
///         strategies for electrohydraulic load-sensing".
struct PumpDemand {
  std::size_t pump = 0;
  std::vector<double> others_m3ps, others_w;
  /// Oil volume of the axis per radian, for positive and negative rates.
  std::vector<double> positive_m3prad, negative_m3prad;
  /// Time in which the axis and other functions demand oil together, and the largest total demand.
  double together_s = 0, most_m3ps = 0, most_w = 0;

  double Own_m3ps(std::size_t step, double rate_radps) const {
    return rate_radps > 0 ? positive_m3prad[step] * rate_radps
                          : -negative_m3prad[step] * rate_radps;
  }
};

/// Returns nothing for an axis without a pump or with several.
std::optional<PumpDemand> PumpDemandOf(const MachineModel& model, const AxisLog& log,
                                       std::size_t axis);

}  // namespace tera
