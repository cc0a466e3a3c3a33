#pragma once

#include <filesystem>

#include "dataset/import/cloud/point_cloud.h"

namespace tera {

/// Reads a point cloud in the format given by the file name extension.
///
/// Model   .pcd: PCD 0.5 to 0.7 (ascii, binary or binary_compressed) with fields x, y, z as floats
///         of 4 or 8 bytes. .ply: PLY 1.0 (ascii or either binary form) with properties x, y, z of
///         the element vertex. .las: LAS 1.0 to 1.4, point formats 0 to 10. LAS points of class 7
///         or 18 (noise) and withheld points are skipped.
/// Omits   other fields; the VIEWPOINT of a PCD file, which common readers do not apply to the
///         points; faces; LAZ, the compressed form of LAS.
/// Throws  InputError if the file has none of these formats, is truncated, has no points, or has
///         more than 1e8.
/// Source  Point Cloud Library, "The PCD (Point Cloud Data) file format"; Turk, "The PLY polygon
///         file format", 1994; ASPRS, "LAS specification 1.4 - R15", 2019.
PointCloud ReadPointCloud(const std::filesystem::path& file);

}  // namespace tera
