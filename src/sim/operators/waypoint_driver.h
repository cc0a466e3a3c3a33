#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/config/config.h"
#include "sim/operators/operator.h"
#include "sim/operators/skid_steer.h"

namespace tera {

struct WaypointPlan {
  std::vector<Vec2> waypoints_W_m;
  double speed_mps = 0.8;
  double reached_m = 0.5;  ///< distance at which a waypoint counts as reached
  SkidSteerLevers levers;
};

/// Drives through waypoints with left and right tracks or wheels.
///
/// Frames  waypoints in W.
/// Model   pure pursuit: curvature 2 sin(alpha) / d towards the waypoint at the bearing alpha and
///         the distance d. At large bearings the machine turns on the spot. It slows down for the
///         last waypoint and stops there. Lever rates are limited to those of a human hand.
/// Source  Coulter 1992, CMU-RI-TR-92-01.
class WaypointDriver : public Operator {
 public:
  explicit WaypointDriver(WaypointPlan plan) : plan_(std::move(plan)) {}
  std::vector<double> Levers(const OperatorView& view) override;

 private:
  /// Levers for the machine's current pose.
  std::vector<double> Wanted(const OperatorView& view);

  WaypointPlan plan_;
  std::size_t next_ = 0;
  std::vector<double> levers_now_;  ///< last output
  std::optional<TimeNs> last_ns_;   ///< time of the last output
};

/// Reads the keys of `type: waypoints`.
WaypointPlan ReadWaypointPlan(const ConfigMap& config, const MachineModel& model);

}  // namespace tera
