#pragma once

#include <vector>

#include "core/config/config.h"
#include "soil/columns/columns.h"

namespace tera {

/// Two ruts that wheels or tracks have pressed before the start, or one where there is no gauge.
///
/// Frames  W.
/// Model   a path of straight pieces; each rut runs half the gauge beside it, level across its
///         floor and with shoulders of a fifth of its width. Soil is pressed as by a machine's
///         running gear (Columns::Press): it becomes denser and remembers it.
struct RutPlan {
  std::vector<Vec2> path_W_m;
  double gauge_m = 0;  ///< between the middles of the two
  double width_m = 0;  ///< of each
  double depth_m = 0;
};

/// Reads `ruts`. Faults go to `config`. What lies beyond the site is left out.
std::vector<RutPlan> ReadRuts(const ConfigMap& config);

/// Presses them, across each other each by its own depth.
void Press(const RutPlan& ruts, Columns* ground);

}  // namespace tera
