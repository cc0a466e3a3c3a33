#pragma once

#include <map>
#include <vector>

#include "core/config/config.h"
#include "soil/columns/undisturbed_ground.h"
#include "soil/site/soil_catalogue.h"

namespace tera {

/// Soils below a site's surface, by place.
struct SiteProfiles {
  std::vector<GroundProfile> profiles;  ///< the first one wherever no region lies, or a map's
  std::vector<ProfileRegion> regions;   ///< later ones lie over earlier ones
  std::map<std::uint8_t, std::uint8_t> profile_of_class;  ///< of `soil_classes`; empty without
};

/// Reads `soil`, `layers` or the classes of `soil_classes`, and `soils`, `strips` and `regions` of
/// a terrain mapping. Faults go to `config`.
SiteProfiles ReadProfiles(const ConfigMap& config, SoilCatalogue* soils);

}  // namespace tera
