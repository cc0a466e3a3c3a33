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
/// Model   From above, an obstacle counts as a surface: the upper faces of its boxes. A tilted box
///         is a ramp. Beside a box the height falls at 45 deg to the foot of the box. The round end
///         of a sprocket overhangs an edge about as far before it touches. For a point inside a
///         box, the path out is the shortest one through any face except the lowest. Queries ignore
///         obstacles that rise higher than the given climb height.
/// Omits   Obstacles that sink, tilt or slip under running gear.
class LowObstacles {
 public:
  /// Adds an obstacle at the origin of W and returns its handle.
  int Add(const RigidObstacle& obstacle);
  void Move(int handle, const BodyState& carrier);
  bool any() const { return !placed_.empty(); }

  /// The upper side of an obstacle.
  struct Top {
    double z_m;
    Vec3 v_W_mps;  ///< velocity of the obstacle at this point
  };
  /// The highest obstacle at (x, y) among those that rise at most `climb_m`.
  std::optional<Top> TopAt(double x_m, double y_m, double climb_m) const {
    return climb_m < lowest_rise_m_ ? std::nullopt : HighestAt(x_m, y_m, climb_m);
  }

  struct Exit {
    GroundExit way;
    Vec3 v_W_mps;
  };
  /// The path out of the box in which `p_W_m` lies deepest; empty if the point is in no box.
  std::optional<Exit> ExitFrom(const Vec3& p_W_m, double climb_m) const;

 private:
  struct Placed {
    RigidObstacle obstacle;
    double reach_m;  ///< radius about the origin that contains the obstacle and its slopes
    BodyState state;
  };
  std::optional<Top> HighestAt(double x_m, double y_m, double climb_m) const;

  std::vector<Placed> placed_;
  double lowest_rise_m_ = std::numeric_limits<double>::infinity();
};

}  // namespace tera
