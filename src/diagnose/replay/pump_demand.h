#pragma once

#include <optional>
#include <vector>

#include "core/types/effects.h"
#include "diagnose/replay/axis_log.h"
#include "physics/actuation/pump_flow.h"
#include "physics/description/machine.h"

namespace tera {

/// The demand on the pump that feeds one axis, at each step of a log.
///
/// Model   each of the pump's other functions asks what its own chain makes of its recorded lever,
///         as the model has it; the axis takes oil by its displacement at the measured position.
/// Omits   axes that several pumps feed; the effect of an axis's own `cylinder_lever` on oil and
///         power.
/// Source  that of flow_sharing (docs/reference/mechanisms.md): Djurovic and Helduser 2004, "New
/// control
///         strategies for electrohydraulic load-sensing".
struct PumpDemand {
  std::size_t pump = 0;
  std::vector<double> others_m3ps, others_w;
  /// Oil that the axis takes for a radian, by the sign of its rate.
  std::vector<double> positive_m3prad, negative_m3prad;
  /// Time for which the axis and others ask together, and the largest demand of all of them.
  double together_s = 0, most_m3ps = 0, most_w = 0;

  double Own_m3ps(std::size_t step, double rate_radps) const {
    return rate_radps > 0 ? positive_m3prad[step] * rate_radps
                          : -negative_m3prad[step] * rate_radps;
  }
};

/// The demand on an axis's pump; none for an axis that no pump or more than one feeds.
std::optional<PumpDemand> PumpDemandOf(const MachineModel& model, const AxisLog& log,
                                       std::size_t axis);

}  // namespace tera
