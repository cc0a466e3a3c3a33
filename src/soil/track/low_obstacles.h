#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/types/rigid_obstacle.h"
#include "soil/track/ground_exit.h"

namespace tera {

/// Rigid obstacles on the ground, as running gear meets them.
///
/// Frames  W.
/// Model   Seen from above, a height: that of the boxes' upper faces (a tilted box is a ramp).
///         Beside them it falls off at 45 deg down to the box's foot. This is as far out as a
///         sprocket's round end overhangs an edge before it touches it. Seen from within, the
///         shortest way out of a box by any face but the lowest. Whoever asks says how high it
///         climbs; obstacles that rise higher are not there.
/// Omits   that they sink, tilt or slip under running gear.
class LowObstacles {
 public:
  /// Adds an obstacle at W's origin; returns its handle.
  int Add(const RigidObstacle& obstacle);
  void Move(int handle, const BodyState& carrier);
  bool any() const { return !placed_.empty(); }

  /// Upper side of an obstacle.
  struct Top {
    double z_m;
    Vec3 v_W_mps;  ///< of the obstacle there
  };
  /// The highest over (x, y) of obstacles that rise no more than `climb_m`.
  std::optional<Top> TopAt(double x_m, double y_m, double climb_m) const {
    return climb_m < lowest_rise_m_ ? std::nullopt : HighestAt(x_m, y_m, climb_m);
  }

  struct Exit {
    GroundExit way;
    Vec3 v_W_mps;
  };
  /// The way out of the box that `p_W_m` is deepest in, if it is in one.
  std::optional<Exit> ExitFrom(const Vec3& p_W_m, double climb_m) const;

 private:
  struct Placed {
    RigidObstacle obstacle;
    double reach_m;  ///< farther from its origin nothing stands over the ground
    BodyState state;
  };
  std::optional<Top> HighestAt(double x_m, double y_m, double climb_m) const;

  std::vector<Placed> placed_;
  double lowest_rise_m_ = std::numeric_limits<double>::infinity();
};

}  // namespace tera
