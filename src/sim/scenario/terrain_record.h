#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/time.h"
#include "soil/soil.h"

namespace tera {

/// What a recording contains of the ground, at the start and the end, and optionally periodically.
struct TerrainRecord {
  struct Voxels {
    std::string name;
    VoxelBox box;
  };
  std::vector<GroundRaster> rasters;
  int columns_per_pixel = 1;
  std::optional<TimeNs> period_ns;  ///< also record at multiples of this
  std::vector<Voxels> voxels;
};

/// Reads a scenario's `record:`, if it has one. Faults go to `config`.
TerrainRecord ReadTerrainRecord(const std::optional<ConfigMap>& config, const TerrainGrid& site);

}  // namespace tera
