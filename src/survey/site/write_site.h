#pragma once

#include <filesystem>
#include <string>

#include "survey/site/survey_site.h"

namespace tera {

/// Writes a site into the existing `folder`: `terrain.tif` and `mask.tif` (terrain.h), a mesh for
/// each thing, the scenario `site.yaml` and the summary `site.json`. The things are the scenario's
/// obstacles. `name` is the scenario's name; `source` names the survey.
///
/// Throws  InputError if a file cannot be written.
void WriteSite(const SurveySite& site, const std::string& name, const std::string& source,
               const std::filesystem::path& folder);

}  // namespace tera
