#pragma once

#include <filesystem>

#include "diagnose/diagnosis.h"
#include "soil/soil.h"

namespace tera {

/// Beside the report the map of each sensor that has one: ground_<sensor>.tif, measured ground over
/// simulated ground in metres. Throws InputError where it cannot be written.
void WriteGroundMaps(const std::filesystem::path& directory, const Diagnosis& diagnosis,
                     const SiteOrigin& origin);

}  // namespace tera
