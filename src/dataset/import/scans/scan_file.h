#pragma once

#include <filesystem>

#include "dataset/import/scans/point_records.h"

namespace tera {

/// Reads a file that holds one scan.
///
/// Model   .pcd: PCD 0.7 (ascii, binary or binary_compressed) with the fields of RecordReader.
///         .ply: vertices with the same fields. .bin: a Velodyne scan of KITTI, with x, y, z and
///         reflectance (0 to 1) as 4-byte floats.
/// Source  Point Cloud Library, "The PCD (Point Cloud Data) file format"; KITTI's raw data,
///         dataformat.
UnitScan ReadScanFile(const std::filesystem::path& file, const PointForm& form, TimeNs stamp_ns);

}  // namespace tera
