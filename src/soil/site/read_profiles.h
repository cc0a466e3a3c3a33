#pragma once

#include <map>
#include <vector>

#include "core/config/config.h"
#include "soil/columns/undisturbed_ground.h"
#include "soil/site/soil_catalogue.h"

namespace tera {

/// Soil profiles of a site, by place.
struct SiteProfiles {
  /// the first one applies outside all regions, unless there is a class map
  std::vector<GroundProfile> profiles;
  std::vector<ProfileRegion> regions;  ///< later regions cover earlier ones
  /// by class of `soil_classes`; empty without a class map
  std::map<std::uint8_t, std::uint8_t> profile_of_class;
};

/// Reads `soil`, `layers`, `soil_classes`, `soils`, `strips` and `regions` of a terrain mapping.
/// Faults go to `config`.
SiteProfiles ReadProfiles(const ConfigMap& config, SoilCatalogue* soils);

}  // namespace tera
