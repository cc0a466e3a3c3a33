#pragma once

#include "core/motion.h"

namespace tera {

/// A spotlight.
///
/// Frames  B the carrying body, or W; L the lamp, with its beam along x.
/// Model   luminous intensity I(a) = I0 (1 - (a / h)^2)^2 at angle a from the beam; zero beyond the
///         half angle h. I0 follows from the total flux flux_lm. Light is white (D65).
struct Lamp {
  int body = -1;  ///< index into SceneState::X_WB; -1: fixed in W
  Pose X_BL = Pose::Identity();
  double flux_lm = 0;
  double half_angle_rad = 0;
};

/// I0 of a lamp, cd.
double PeakIntensity_cd(const Lamp& lamp);

}  // namespace tera
