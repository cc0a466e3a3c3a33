#pragma once

#include <filesystem>

#include "diagnose/diagnosis.h"

namespace tera {

/// Writes beside the report the map of each sensor that has one: ground_<sensor>.tif, measured
/// ground over simulated ground in metres. Throws InputError where it cannot be written.
void WriteGroundMaps(const std::filesystem::path& directory, const Diagnosis& diagnosis);

}  // namespace tera
