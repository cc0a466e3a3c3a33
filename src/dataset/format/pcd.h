#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// A scan as a PCD file, version 0.7, data binary_compressed: the fields x y z intensity (float),
/// time (uint32, ns since the scan's t_ns), ring and instance (uint16), label (uint8), stored field
/// by field and packed by LZF.
///
/// Source  Point Cloud Library, "The PCD (Point Cloud Data) file format".
std::string EncodePcd(const std::vector<LidarPoint>& points);

/// Reads such a file back. Throws InputError with the file, and with the line for a fault in the
/// header.
std::vector<LidarPoint> ReadPcd(const std::filesystem::path& file);

}  // namespace tera
