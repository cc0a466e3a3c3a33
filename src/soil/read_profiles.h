#pragma once

#include <vector>

#include "core/config.h"
#include "soil/soil_catalogue.h"
#include "soil/undisturbed_ground.h"

namespace tera {

/// What lies where below a site's surface.
struct SiteProfiles {
  std::vector<GroundProfile> profiles;  ///< the first one wherever no region lies
  std::vector<ProfileRegion> regions;   ///< later ones lie over earlier ones
};

/// Reads `soil` or `layers`, `soils`, `strips` and `regions` of a terrain mapping. Faults go to
/// `config`.
SiteProfiles ReadProfiles(const ConfigMap& config, SoilCatalogue* soils);

}  // namespace tera
