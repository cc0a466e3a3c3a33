#pragma once

#include <string>

#include "core/motion.h"

namespace tera {

/// A spotlight on a machine's link or on an invisible mast.
///
/// Frames  P is the link, or W with heights above the ground. L is the lamp, with its beam along x.
struct ScenarioLamp {
  std::string machine, link;  ///< empty: on a mast, fixed in W
  Pose X_PL = Pose::Identity();
  double flux_lm = 0;
  double half_angle_rad = 0;
};

}  // namespace tera
