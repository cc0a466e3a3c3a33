#pragma once

#include <optional>
#include <vector>

#include "core/types/effects.h"
#include "diagnose/replay/base_log.h"

namespace tera {

struct PoseStamps {
  bool of_arrival = false;  ///< true: stamps are times of arrival; false: times of measurement
  double late_s = 0;        ///< added to all stamps
};

/// Ground friction that limits the machine's acceleration.
struct Grip {
  double friction;
  double yaw_inertia_kgm2;  ///< yaw inertia of the whole machine, positive
};

/// Replays the base's motion on the ground. Inputs are the measured rates of the running gear and
/// the measured attitude. Output is the motion with other effects of the slot `ground`, such as
/// slip (docs/reference/mechanisms.md).
///
/// Frames  B root link; twists as in BaseLog.
/// Model   MoveOnTracks gives a twist in every step. Displacements are summed between the
///         measurement times of an interval's two poses. The sum, divided by the time between the
///         poses' stamps, is the mean twist. With a grip, friction under each side limits the
///         acceleration of mass and inertia, forward and in yaw. The machine then starts with its
///         first measured motion.
/// Omits   Lateral inertia, gravity along a slope, limits of the motors, friction against turning,
///         ground forces on tools.
class BaseReplay {
 public:
  /// `model` and `log` must outlive this object.
  BaseReplay(const MachineModel& model, const BaseLog& log) : model_(model), log_(log) {}

  /// Mean twists with `base` in place of the model's effects, one per interval. Without a grip, the
  /// machine follows its tracks at once.
  std::vector<PlanarTwist> Predict(const Effects& base, const PoseStamps& stamps = {},
                                   const std::optional<Grip>& grip = {}) const;

 private:
  const MachineModel& model_;
  const BaseLog& log_;
};

}  // namespace tera
