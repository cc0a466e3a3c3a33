#pragma once

#include <optional>
#include <vector>

#include "core/config/config.h"
#include "soil/columns/columns.h"

namespace tera {

inline constexpr double kDeepestRut_m = 0.5;

struct RutSize {
  double gauge_m = 0;  ///< distance between the middles of two ruts; 0 for a single rut
  double width_m = 0;  ///< width of each rut
};

/// Reads `gauge_m` and `width_m`. `width_m` is required if there is no usual width. Faults go to
/// `config`.
RutSize ReadRutSize(const ConfigMap& config, double usual_gauge_m,
                    std::optional<double> usual_width_m);

/// Two parallel ruts that exist before the start, or a single rut if the gauge is 0.
///
/// Frames  W.
/// Model   The path is a polyline; each rut runs half a gauge to its side. The floor is level
///         across, and each shoulder is a fifth of the width. Columns::Press compacts the soil as
///         running gear does, so that the ruts count as loaded before.
struct RutPlan {
  std::vector<Vec2> path_W_m;
  RutSize size;
  double depth_m = 0;
};

/// Reads `ruts`. Faults go to `config`. Ruts may extend beyond the site; Press skips that part.
std::vector<RutPlan> ReadRuts(const ConfigMap& config);

/// Presses the ruts into the ground. Where ruts cross, their depths add.
void Press(const RutPlan& ruts, Columns* ground);

}  // namespace tera
