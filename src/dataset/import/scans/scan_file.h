#pragma once

#include <filesystem>

#include "dataset/import/scans/point_records.h"

namespace tera {

/// Reads one scan file.
///
/// Model   .pcd: PCD 0.7, ascii, binary and binary_compressed, with the fields of RecordReader;
///         .ply: the vertices, with the same fields;
///         .bin: KITTI's Velodyne scans, x, y, z and reflectance (0 to 1) as floats of 4 bytes.
/// Source  Point Cloud Library, "The PCD (Point Cloud Data) file format"; KITTI's raw data,
///         dataformat.
UnitScan ReadScanFile(const std::filesystem::path& file, const PointForm& form, TimeNs stamp_ns);

}  // namespace tera
