#pragma once

#include <string>

#include "dataset/export/cloud/map_points.h"
#include "dataset/format/dataset_info.h"

namespace tera {

/// Points as LAS 1.4, point data record format 6.
///
/// Frames  the transverse Mercator plane about the recording's origin, of scale 1, as the rasters
///         of its ground (soil/site/ground_raster.h): x and y those of W, z above the WGS 84
///         ellipsoid. Where the origin is not known, W.
/// Model   coordinates in tenths of millimetres. Classes: terrain 2 (ground), vegetation 5
///         (high vegetation), structure 6 (building), all others 64 + SemanticClass, of those that
///         the standard leaves to users, which end with label 191: beyond it 1 (unclassified).
///         Intensity over 65535. GPS time: seconds of the recording. Point source: lidar + 1. User
///         data: the low 8 bits of the instance. The plane is named in a record of OGC WKT.
/// Omits   rings.
/// Source  ASPRS, "LAS specification 1.4 - R15", 2019; OGC 01-009, "Coordinate Transformation
///         Services", 2001 (WKT).

/// Where points of W lie in the file.
PlaceOnMap LasPlaces(const DatasetInfo& info);

/// Throws InputError for a point more than 200 km from the origin.
void AppendLasPoint(const MapPoint& point, std::string* bytes);
/// Header and variable length record, before the points.
std::string LasHeader(const MapExtent& extent, const DatasetInfo& info);

}  // namespace tera
