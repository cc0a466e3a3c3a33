#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/config/config.h"
#include "soil/columns/columns.h"
#include "soil/columns/old_ruts.h"
#include "soil/columns/pit.h"
#include "soil/site/given_ground.h"

namespace tera {

/// A cone of loose soil, or a berm: a ridge from one end to the other.
struct PilePlan {
  Vec2 xy_W_m = Vec2::Zero(), end_W_m = Vec2::Zero();  ///< both ends of the crest; equal for a cone
  double height_m = 0;
  std::uint8_t soil = 0;
};

/// The ground at the start, from the scenario's `terrain:` mapping.
struct SitePlan {
  UndisturbedGround ground;
  SoilKinds kinds;
  std::vector<PilePlan> piles;
  std::vector<PitPlan> pits;
  std::vector<RutPlan> ruts;
  std::optional<SiteOrigin> georeference;
  bool has_weather_before = false;
};

/// Reads `size_m cell_m soil soils layers soil_classes custom_soils strips regions relief geotiff
/// piles pits ruts weather_before`. Faults go to `config`. An unusable GeoTIFF is a fault, and so
/// is one together with `given`, which replaces it.
SitePlan ReadSite(const ConfigMap& config, std::uint64_t seed,
                  const std::optional<GivenGround>& given = std::nullopt);

/// Builds the columns of a site with ruts, pits and piles. Piles stand at their angle of repose.
Columns BuildColumns(const SitePlan& plan);

}  // namespace tera
