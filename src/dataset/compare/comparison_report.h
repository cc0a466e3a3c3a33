#pragma once

#include <filesystem>
#include <string>

#include "dataset/compare/compare.h"

namespace tera {

/// JSON of a comparison: trajectories, channels, scans and images of each machine.
std::string ComparisonJson(const Comparison& comparison);

/// Writes images of the worst frames of each lidar and camera to a new folder, as
/// <machine>_<sensor>_<place>_<t_ns>.png with the reference on the left. Scans are drawn from above
/// at equal scale. Returns the number of files. Throws InputError if the folder contains files.
int WriteWorstFrames(const Comparison& comparison, const std::filesystem::path& a,
                     const std::filesystem::path& b, const std::filesystem::path& folder);

}  // namespace tera
