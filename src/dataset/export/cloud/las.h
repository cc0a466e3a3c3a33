#pragma once

#include <string>

#include "dataset/export/cloud/map_points.h"
#include "dataset/format/dataset_info.h"

namespace tera {

/// Points as LAS 1.4, point data record format 6.
///
/// Frames  the transverse Mercator plane about the recording's origin, scale 1, as in the ground
///         rasters (soil/site/ground_raster.h): x and y of W, z above the WGS 84 ellipsoid. W if
///         the origin is unknown.
/// Model   coordinates in tenths of millimetres. Classes: terrain 2 (ground), vegetation 5 (high
///         vegetation), structure 6 (building). Other classes are 64 + SemanticClass in the
///         standard's user range, up to label 191; higher labels are 1 (unclassified). Intensity
///         times 65535. GPS time: seconds of the recording. Point source: lidar + 1. User data: the
///         low 8 bits of the instance. An OGC WKT record names the plane.
/// Omits   rings.
/// Source  ASPRS, "LAS specification 1.4 - R15", 2019; OGC 01-009, "Coordinate Transformation
///         Services", 2001 (WKT).

/// Map from W to the file's coordinates.
PlaceOnMap LasPlaces(const DatasetInfo& info);

/// Throws InputError for a point more than 200 km from the origin.
void AppendLasPoint(const MapPoint& point, std::string* bytes);
/// Header and variable length record, before the points.
std::string LasHeader(const MapExtent& extent, const DatasetInfo& info);

}  // namespace tera
