#pragma once

#include <filesystem>
#include <string>

#include "dataset/compare/compare.h"

namespace tera {

/// The numbers of a comparison as JSON: trajectories, channels, scans and pictures of each machine.
std::string ComparisonJson(const Comparison& comparison);

/// Writes the worst frames of every lidar and camera into a new folder, reference left and compared
/// right, each as <machine>_<sensor>_<place>_<t_ns>.png: scans from above at one scale, pictures as
/// they are. Returns the number of files. Throws InputError if the folder holds files.
int WriteWorstFrames(const Comparison& comparison, const std::filesystem::path& a,
                     const std::filesystem::path& b, const std::filesystem::path& folder);

}  // namespace tera
