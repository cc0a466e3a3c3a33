#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/import/scans/point_records.h"

namespace tera {

/// Scan files of a folder, .pcd and .bin, in natural order of their names. Throws InputError where
/// there are none.
std::vector<std::filesystem::path> ScanFilesOf(const std::filesystem::path& folder);

/// Reads one scan file.
///
/// Model   .pcd: PCD 0.7, ascii, binary and binary_compressed, with the fields of RecordReader;
///         .bin: KITTI's Velodyne scans, x, y, z and reflectance (0 to 1) as floats of 4 bytes.
/// Omits   PLY.
/// Source  Point Cloud Library, "The PCD (Point Cloud Data) file format"; KITTI's raw data,
///         dataformat.
UnitScan ReadScanFile(const std::filesystem::path& file, const PointForm& form, TimeNs stamp_ns);

/// Time in a scan's file name. Digits are ns, us, ms or s since 1970, by their number; a point
/// marks seconds, as in "1403636579.763555". A name with fewer digits has no time.
std::optional<TimeNs> StampOfName(const std::filesystem::path& file);

/// Reads scan times, one on each line: seconds (1403636579.763555), ns for an integer above 1e17,
/// or a date with a time of day, as KITTI writes.
std::vector<TimeNs> ReadScanTimes(const std::filesystem::path& file);

}  // namespace tera
