#pragma once

#include "core/motion.h"

namespace tera {

/// A spotlight.
///
/// Frames  B the carrying body, or W; L the lamp, with its beam along x.
/// Model   luminous intensity I(a) = I0 (1 - (a / h)^2)^2 at the angle a from the beam, and 0
///         beyond the half angle h. I0 follows from the total luminous flux flux_lm. The light is
///         white (D65).
struct Lamp {
  int body = -1;  ///< index into SceneState::X_WB; -1: fixed in W
  Pose X_BL = Pose::Identity();
  double flux_lm = 0;
  double half_angle_rad = 0;
};

/// I0 of a lamp, in cd.
double PeakIntensity_cd(const Lamp& lamp);

}  // namespace tera
