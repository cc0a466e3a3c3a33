#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/motion.h"

namespace tera {

/// The positions of a file's points.
///
/// Frames  that of the file, in metres: a map's easting, northing and height, or any other.
struct PointCloud {
  std::vector<Vec3> p_m;
  /// The file's reference system as OGC WKT or "EPSG:n", or words if it has no code; empty if it
  /// names none.
  std::string map;
  Vec3 step_m = Vec3::Zero();      ///< resolution of the coordinates in a LAS file
  std::int64_t without_place = 0;  ///< skipped points with a coordinate that is not finite
  std::int64_t marked = 0;         ///< skipped points that a LAS file marks as noise or withheld
};

}  // namespace tera
