#pragma once

#include <optional>
#include <vector>

#include "core/types/effects.h"
#include "diagnose/replay/base_log.h"

namespace tera {

/// The meaning of the stamps of poses.
struct PoseStamps {
  bool of_arrival = false;  ///< the stamps are of arrival, else of measurement
  double late_s = 0;        ///< delay of all stamps
};

/// Limits of the ground on a machine's acceleration.
struct Grip {
  double friction;
  double yaw_inertia_kgm2;  ///< of the machine; above 0
};

/// The ground slot alone, driven by measured rates of the running gear and the base's measured
/// attitude. Gives the base's motion on tracks with other effects.
///
/// Frames  B root link; twists as in BaseLog.
/// Model   MoveOnTracks in every step, summed between the measurements of an interval's poses, and
///         divided by the time between their stamps for the mean twist. With a grip, friction under
///         either side limits the acceleration of mass and inertia, forward and turning. The
///         machine starts with its first measured motion.
/// Omits   lateral inertia, gravity along a slope, limits of the motors, friction against turning,
///         forces of the ground on tools.
class BaseReplay {
 public:
  /// Both must outlive it.
  BaseReplay(const MachineModel& model, const BaseLog& log) : model_(model), log_(log) {}

  /// Mean twists with `base` in place of the model's own effects, one for each interval. Without a
  /// grip the machine follows its tracks at once.
  std::vector<PlanarTwist> Predict(const Effects& base, const PoseStamps& stamps = {},
                                   const std::optional<Grip>& grip = {}) const;

 private:
  const MachineModel& model_;
  const BaseLog& log_;
};

}  // namespace tera
