#pragma once

#include <filesystem>
#include <string>

#include "survey/site/survey_site.h"

namespace tera {

/// Writes a site to the existing `folder`: `terrain.tif` and `mask.tif` (terrain.h), a mesh for
/// each object (things.h), the scenario `site.yaml` and the summary `site.json`. The objects become
/// obstacles of the scenario. `name` is the name of the scenario; `source` names the survey.
///
/// Throws  InputError if a file cannot be written.
void WriteSite(const SurveySite& site, const std::string& name, const std::string& source,
               const std::filesystem::path& folder);

}  // namespace tera
