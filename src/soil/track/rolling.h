#pragma once

#include <vector>

#include "core/types/ground_tools.h"
#include "soil/columns/columns.h"

namespace tera {

/// How much softer ground is under a wheel that rolls and slips than under a plate: it bears what
/// Bekker's plate would at `ease` times its sinkage, p = p_B(ease z). Under a track, `ease` is 1.
///
/// Frames  B the frame of the gear's link; W.
/// Model   A wheel's patches lie on a circle, to both sides of straight down. The stress at theta
///         from there is greatest at theta_m = (c1 + c2 i) theta_1, theta_1 where the rim enters
///         the ground, and falls off to nothing below the axle: behind theta_m, ease has the factor
///         (cos theta' - cos theta_1) / (cos theta - cos theta_1), theta' = theta_1 - theta
///         (theta_1 - theta_m) / theta_m. It is as much nearer to 1 as the wheel has not rolled
///         over its contact's length yet, or as its sinkage is elastic. Soil that has flowed back
///         behind the axle thus bears as what has not been pressed.
///         Slip sinkage: ease has the factor (1 - i / 2) / (1 + i), i = rho / (1 + rho), where rho
///         is what the ground under the wheel has been slipped over, as a multiple of the contact's
///         length. At steady slip i is the slip; under a locked wheel that skids, 1 / 2.
/// Source  Wong and Reece 1967, J. Terramechanics 4(1): peak and rear of the stress, with c1 = 0.4
///         and c2 = 0.15 of the ranges in Ishigami, Miwa, Nagatani and Yoshida 2007, J. Field
///         Robotics 24(3). Slip sinkage: Lyasko 2010, J. Terramechanics 47. Skid as slip is an
///         estimate.
/// Omits   soil that a wheel carries out behind it; slip across it; slip sinkage of tracks, but for
///         what their grousers carry out, see Rut.
class Rolling {
 public:
  explicit Rolling(const RunningGear& gear);

  /// Before a step in which the gear goes `forward_m` over ground, its shoes `shoe_m` under it;
  /// `contact_m` is the length of ground under the whole gear.
  void Advance(double forward_m, double shoe_m, double contact_m, const Pose& X_WB,
               const Columns& ground);
  /// Of a point of patch `k` that is `along_m` (along travel) from its middle and `pen_m` in ground
  /// that has been pressed in by `pressed_m`.
  double Ease(std::size_t k, double along_m, double pressed_m, double pen_m) const;
  /// Whether patch `k` is part of a wheel.
  bool OnWheel(std::size_t k) const { return at_[k].wheel >= 0; }

 private:
  struct Wheel {
    Vec3 axle_B_m;
    double radius_m;
    double entry_rad = 0;  ///< theta_1, on the side to which it rolls
    double rolled = 0;     ///< -1 to 1: contact's length, forwards, or further
  };
  struct Place {
    int wheel = -1;
    double angle_rad = 0;  ///< from straight down, positive to the front
  };
  void FindWheels(const RunningGear& gear);

  std::vector<Wheel> wheels_;
  std::vector<Place> at_;  ///< of each patch
  double slipped_ = 0;     ///< rho
};

}  // namespace tera
