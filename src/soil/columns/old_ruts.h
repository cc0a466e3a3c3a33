#pragma once

#include <optional>
#include <vector>

#include "core/config/config.h"
#include "soil/columns/columns.h"

namespace tera {

inline constexpr double kDeepestRut_m = 0.5;

struct RutSize {
  double gauge_m = 0;  ///< between the middles of two; 0 of one
  double width_m = 0;  ///< of each
};

/// Reads `gauge_m` and `width_m`; without a usual width, it must be there. Faults go to `config`.
RutSize ReadRutSize(const ConfigMap& config, double usual_gauge_m,
                    std::optional<double> usual_width_m);

/// Two ruts that wheels or tracks have pressed before the start, or one where there is no gauge.
///
/// Frames  W.
/// Model   a path of straight pieces; each rut runs half the gauge beside it, level across its
///         floor and with shoulders of a fifth of its width. Soil is pressed as by a machine's
///         running gear (Columns::Press): it becomes denser and remembers it.
struct RutPlan {
  std::vector<Vec2> path_W_m;
  RutSize size;
  double depth_m = 0;
};

/// Reads `ruts`. Faults go to `config`. Ruts beyond the site are left out.
std::vector<RutPlan> ReadRuts(const ConfigMap& config);

/// Presses them, across each other each by its own depth.
void Press(const RutPlan& ruts, Columns* ground);

}  // namespace tera
