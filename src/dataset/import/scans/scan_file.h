#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/import/scans/point_records.h"

namespace tera {

/// The scans of a folder, .pcd and .bin, in the order of their names; numbers in names count by
/// their values. InputError where there is none.
std::vector<std::filesystem::path> ScanFilesOf(const std::filesystem::path& folder);

/// One of them.
///
/// Model   .pcd: PCD 0.7, ascii, binary and binary_compressed, with the fields of RecordReader;
///         .bin: KITTI's Velodyne scans, x, y, z and reflectance (0 to 1) as floats of 4 bytes.
/// Omits   PLY.
/// Source  Point Cloud Library, "The PCD (Point Cloud Data) file format"; KITTI's raw data,
///         dataformat.
UnitScan ReadScanFile(const std::filesystem::path& file, const PointForm& form, TimeNs stamp_ns);

/// The time that a scan's name says: digits are ns, us, ms or s since 1970 by their number, or with
/// a point "1403636579.763555" s; a name of fewer digits has none.
std::optional<TimeNs> StampOfName(const std::filesystem::path& file);

/// The times of the scans: a line each, of seconds (1403636579.763555), of ns where it is whole and
/// beyond 1e17, or a date with a time of day, as KITTI has them.
std::vector<TimeNs> ReadScanTimes(const std::filesystem::path& file);

}  // namespace tera
