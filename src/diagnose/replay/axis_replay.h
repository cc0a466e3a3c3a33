#pragma once

#include <vector>

#include "diagnose/replay/axis_log.h"

namespace tera {

/// The chain of actuation alone, driven by recorded levers at measured positions and loads: what
/// the joints and gears of a machine with other effects would have done in the same place. Errors
/// stay where they arise and do not drift.
///
/// Model   Actuation over the steps of the log; a joint runs as its drive asks, which is what its
///         motor does where it is not held up.
/// Omits   joints that the ground, their end stops or their effort limits hold up; the inertia that
///         an effort has to accelerate; `payload`, whose weight is not in the log's loads; which
///         messages `command_drops` lost, for it draws its own.
class AxisReplay {
 public:
  /// Both must outlive it.
  AxisReplay(const MachineModel& model, const AxisLog& log) : model_(model), log_(log) {}

  /// Rates with `effects` in place of the model's own, one list for each of the log's measured
  /// rates, at their times.
  std::vector<std::vector<double>> Predict(const MachineEffects& effects) const;

 private:
  const MachineModel& model_;
  const AxisLog& log_;
};

}  // namespace tera
