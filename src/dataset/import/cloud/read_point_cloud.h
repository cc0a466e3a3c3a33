#pragma once

#include <filesystem>

#include "dataset/import/cloud/point_cloud.h"

namespace tera {

/// Reads a point cloud in the format of the file's extension.
///
/// Model   .pcd: PCD 0.5 to 0.7, ascii, binary and binary_compressed, fields x, y and z as floats
///         of 4 or 8 bytes. .ply: PLY 1.0, ascii and both binary forms, properties x, y and z of
///         the element vertex. .las: LAS 1.0 to 1.4, point formats 0 to 10; points of class 7 or 18
///         (noise) and withheld ones are left out.
/// Omits   other fields of a point; the VIEWPOINT of a PCD file, which no reader applies to the
///         points; faces; LAZ, the compressed form of LAS.
/// Throws  InputError for a file that is none of these, is truncated, has no point, or more than
///         1e8.
/// Source  Point Cloud Library, "The PCD (Point Cloud Data) file format"; Turk, "The PLY polygon
///         file format", 1994; ASPRS, "LAS specification 1.4 - R15", 2019.
PointCloud ReadPointCloud(const std::filesystem::path& file);

}  // namespace tera
