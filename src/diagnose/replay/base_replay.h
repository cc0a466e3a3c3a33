#pragma once

#include <optional>
#include <vector>

#include "core/types/effects.h"
#include "diagnose/replay/base_log.h"

namespace tera {

/// The meaning of the stamps of poses.
struct PoseStamps {
  bool of_arrival = false;  ///< the stamps are of arrival, else of measurement
  double late_s = 0;        ///< by which all stamps are late
};

/// Limits of the ground on a machine's acceleration.
struct Grip {
  double friction;
  double yaw_inertia_kgm2;  ///< of the machine; above 0
};

/// The ground slot alone, driven by the measured rates of the running gear and the base's measured
/// attitude: the motion of the base that tracks with other effects would have caused.
///
/// Frames  B root link; twists as in BaseLog.
/// Model   MoveOnTracks in every step, summed over the time between the measurements of an
///         interval's poses, and divided by the time between their stamps for the mean twist.
///         Where a grip is given, the machine gains and loses speed, forward and turning, no faster
///         than friction under either side pushes its mass and turns its inertia; it begins as it
///         was measured first.
/// Omits   inertia sideways, gravity along a slope, limits of the motors, what friction does
///         against turning, forces of the ground on tools.
class BaseReplay {
 public:
  /// Both must outlive it.
  BaseReplay(const MachineModel& model, const BaseLog& log) : model_(model), log_(log) {}

  /// Mean twists with `base` in place of the model's own effects, one an interval. Without a grip
  /// the machine follows its tracks at once.
  std::vector<PlanarTwist> Predict(const Effects& base, const PoseStamps& stamps = {},
                                   const std::optional<Grip>& grip = {}) const;

 private:
  const MachineModel& model_;
  const BaseLog& log_;
};

}  // namespace tera
