#pragma once

#include <vector>

#include "core/config/config.h"
#include "soil/columns/columns.h"

namespace tera {

/// An excavation that exists at the start, with vertical walls. Its soil has left the site. The
/// walls may fail from the first step, as any bank.
struct PitPlan {
  std::vector<Vec2> outline_W_m;
  double depth_m = 0;  ///< below the ground of the site, whose relief the floor follows
};

/// Reads `pits`. Faults go to `config`.
std::vector<PitPlan> ReadPits(const ConfigMap& config, const TerrainGrid& grid);

/// Excavates every column whose middle lies within the outline.
void Dig(const PitPlan& pit, Columns* ground);

}  // namespace tera
