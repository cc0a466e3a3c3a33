#pragma once

#include <vector>

#include "core/effects.h"
#include "diagnose/replay/base_log.h"

namespace tera {

/// What the stamps of poses are.
struct PoseStamps {
  bool of_arrival = false;  ///< else of their measurement
  double late_s = 0;        ///< all of them by as much
};

/// The ground slot alone, driven by the measured rates of the running gear and the base's measured
/// attitude: how tracks with other effects would have moved the machine.
///
/// Frames  B root link; twists as in BaseLog.
/// Model   MoveOnTracks in every step, summed over the time between the measurements of an
/// interval's
///         poses; over the time between their stamps that is the mean twist.
/// Omits   inertia, forces of the ground on tools.
class BaseReplay {
 public:
  /// Both must outlive it.
  BaseReplay(const MachineModel& model, const BaseLog& log) : model_(model), log_(log) {}

  /// Mean twists with `base` in place of the model's own effects, one for each interval.
  std::vector<PlanarTwist> Predict(const Effects& base, const PoseStamps& stamps = {}) const;

 private:
  const MachineModel& model_;
  const BaseLog& log_;
};

}  // namespace tera
