#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Points of a file.
///
/// Frames  The frame of the file, in metres, such as easting, northing and height of a map.
struct PointCloud {
  std::vector<Vec3> p_m;
  /// Coordinate reference system of the file as OGC WKT or "EPSG:n", or as words if it has no code.
  /// Empty if the file names none.
  std::string map;
  Vec3 step_m = Vec3::Zero();      ///< resolution of coordinates in a LAS file
  std::int64_t without_place = 0;  ///< number of skipped points with a coordinate that is not
                                   ///< finite
  std::int64_t marked = 0;  ///< number of skipped points that a LAS file marks as noise or withheld
};

}  // namespace tera
