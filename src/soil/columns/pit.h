#pragma once

#include <vector>

#include "core/config/config.h"
#include "soil/columns/columns.h"

namespace tera {

/// An excavation that is there at the start, its walls upright. The dug soil has left the site. Its
/// walls stand or fail as any bank does, from the first step on.
struct PitPlan {
  std::vector<Vec2> outline_W_m;
  double depth_m = 0;  ///< of its floor, which follows the ground as it was
};

/// Reads `pits`. Faults go to `config`.
std::vector<PitPlan> ReadPits(const ConfigMap& config, const TerrainGrid& grid);

/// Takes out every column whose middle lies within the outline.
void Dig(const PitPlan& pit, Columns* ground);

}  // namespace tera
