#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/config/config.h"
#include "soil/columns/columns.h"
#include "soil/columns/pit.h"

namespace tera {

/// A cone of loose soil.
struct PilePlan {
  Vec2 xy_W_m = Vec2::Zero();
  double height_m = 0;
  std::uint8_t soil = 0;
};

/// The ground at the start: what the scenario's `terrain:` mapping says.
struct SitePlan {
  UndisturbedGround ground;
  std::vector<SoilType> soils;
  std::vector<PilePlan> piles;
  std::vector<PitPlan> pits;
  std::optional<SiteOrigin> georeference;
};

/// Reads `size_m cell_m soil soils layers soil_classes custom_soils strips regions relief geotiff
/// piles pits`. Faults go to `config`; a GeoTIFF that cannot be used is one of them.
SitePlan ReadSite(const ConfigMap& config, std::uint64_t seed);

/// The columns of a site, its pits dug and its piles in place at their angle of repose.
Columns BuildColumns(const SitePlan& plan);

}  // namespace tera
