#pragma once

#include <vector>

#include "core/types/effects.h"
#include "diagnose/replay/effort_log.h"

namespace tera {

/// Effort that a joint's drive needs for the measured motion.
///
/// Model   effort = inertial + weight + friction(rate) + offset. Friction and offset are those of
///         the simulator's slot load_friction, smoothed by the log's Gaussian.
/// Omits   Friction at rest; the log has gaps there.
class EffortReplay {
 public:
  /// `model` and `log` must outlive this object.
  EffortReplay(const MachineModel& model, const EffortLog& log) : model_(model), log_(log) {}

  /// Efforts with `effects` in place of the joint's, one per sample of the log's grid.
  std::vector<double> Predict(const Effects& effects) const;

 private:
  const MachineModel& model_;
  const EffortLog& log_;
};

}  // namespace tera
