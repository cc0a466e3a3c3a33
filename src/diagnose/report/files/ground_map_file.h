#pragma once

#include <filesystem>

#include "diagnose/diagnosis.h"

namespace tera {

/// Writes each sensor's ground map into the report's folder: ground_<sensor>.tif, measured minus
/// simulated ground in metres. Throws InputError where it cannot be written.
void WriteGroundMaps(const std::filesystem::path& directory, const Diagnosis& diagnosis);

}  // namespace tera
