#pragma once

#include <vector>

#include "core/types/effects.h"
#include "diagnose/replay/effort_log.h"

namespace tera {

/// Effort of a joint's drive for the measured motion.
///
/// Model   effort = inertial + weight + friction(rate) + offset, with friction and offset of the
///         simulator's slot load_friction, through the log's Gaussian.
/// Omits   friction at rest, where the log has gaps.
class EffortReplay {
 public:
  /// Both must outlive it.
  EffortReplay(const MachineModel& model, const EffortLog& log) : model_(model), log_(log) {}

  /// Efforts with `effects` in place of the joint's own, one for each sample of the log's grid.
  std::vector<double> Predict(const Effects& effects) const;

 private:
  const MachineModel& model_;
  const EffortLog& log_;
};

}  // namespace tera
