#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/motion.h"

namespace tera {

/// The places of a file's points.
///
/// Frames  that of the file, in metres: a map's easting, northing and height, or any other.
struct PointCloud {
  std::vector<Vec3> p_m;
  /// The reference system that the file names, OGC WKT or "EPSG:n", or words for one that has no
  /// code; empty where it names none.
  std::string map;
  Vec3 step_m = Vec3::Zero();      ///< least difference of coordinates that a LAS file can hold
  std::int64_t without_place = 0;  ///< points with a coordinate that is not finite, left out
  std::int64_t marked = 0;         ///< points that a LAS file marks as noise or withheld, left out
};

}  // namespace tera
