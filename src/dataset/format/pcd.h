#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// Encodes a scan as PCD 0.7 with data binary_compressed (LZF). Fields: x, y, z, intensity (float),
/// time (uint32, ns since the scan's t_ns), ring, instance (uint16), label (uint8). Data is stored
/// field by field.
///
/// Source  Point Cloud Library, "The PCD (Point Cloud Data) file format".
std::string EncodePcd(const std::vector<LidarPoint>& points);

/// Reads such a file. Throws InputError with the file name, and with the line if the header is
/// faulty.
std::vector<LidarPoint> ReadPcd(const std::filesystem::path& file);

}  // namespace tera
