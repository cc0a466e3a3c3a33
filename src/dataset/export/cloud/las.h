#pragma once

#include <string>

#include "dataset/export/cloud/map_points.h"
#include "dataset/format/dataset_info.h"

namespace tera {

/// Encodes points as LAS 1.4, point data record format 6.
///
/// Frames  The map projection is transverse Mercator about the recording's origin with scale 1, as
///         in the ground rasters (soil/site/ground_raster.h). x and y equal those of W; z is the
///         height above the WGS 84 ellipsoid. If the origin is unknown, coordinates are those of W.
/// Model   Coordinates are in units of 0.1 mm. Classification: terrain 2 (ground), vegetation 5
///         (high vegetation), structure 6 (building). Other classes are 64 + SemanticClass, in the
///         user range of the standard, up to label 191; higher labels are 1 (unclassified).
///         Intensity is scaled by 65535. GPS time is the recording's time in seconds. The point
///         source is the lidar's index + 1. User data is the low 8 bits of the instance. An OGC WKT
///         record describes the projection.
/// Omits   rings.
/// Source  ASPRS, "LAS specification 1.4 - R15", 2019; OGC 01-009, "Coordinate Transformation
///         Services", 2001 (WKT).

/// The map from W to the coordinates in the file.
PlaceOnMap LasPlaces(const DatasetInfo& info);

/// Throws InputError for a point more than 200 km from the origin.
void AppendLasPoint(const MapPoint& point, std::string* bytes);
/// Header and variable length record, which precede the points.
std::string LasHeader(const MapExtent& extent, const DatasetInfo& info);

}  // namespace tera
