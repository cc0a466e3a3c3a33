#pragma once

#include <filesystem>
#include <string>

#include "survey/site/survey_site.h"

namespace tera {

/// Writes a site into a folder that is there: `terrain.tif` and `mask.tif` (terrain.h), a mesh for
/// each thing, `site.yaml`, a scenario with the things as obstacles, and `site.json`, what was
/// found. `name` is the scenario's; `source` is what the survey is called. Throws InputError where
/// something cannot be written.
void WriteSite(const SurveySite& site, const std::string& name, const std::string& source,
               const std::filesystem::path& folder);

}  // namespace tera
