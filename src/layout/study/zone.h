#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/config/config.h"
#include "core/motion.h"

namespace tera {

/// Name of the zone around the machine. Every study has it.
inline constexpr char kAroundZone[] = "around";

/// A box, centred on the origin of its zone's frame Z.
struct ZoneBox {
  Vec3 size_m = Vec3::Ones();
};

/// An upright cylinder whose base is centred on the origin of Z.
struct ZoneCylinder {
  double radius_m = 1, height_m = 1;
};

/// A prism: a polygon in x and y of Z, extruded between two heights. Corners are in order around
/// the polygon.
struct ZonePrism {
  std::vector<Vec2> corners_m;
  double low_m = 0, high_m = 1;
};

/// A volume whose coverage is measured.
///
/// Frames  F is the reference frame: W or a link of the machine. With `level`, F takes only the
///         link's position and heading and stands upright. Z is the shape's own frame, at X_FZ.
struct Zone {
  std::string name;
  std::string frame = "W";  ///< "W" or a link's name
  bool level = true;
  std::string place = "study: zone";  ///< its position in the study file, for messages
  bool on_ground = false;             ///< move F vertically onto the ground below the link's origin
  Pose X_FZ = Pose::Identity();
  std::variant<ZoneBox, ZoneCylinder, ZonePrism> shape = ZoneBox{};
};

/// Reads a zone. Faults go to `config`. The caller checks the name of the link.
Zone ReadZone(const ConfigMap& config);

double Volume_m3(const Zone& zone);
/// About `count` random points in Z: one in each cell of a grid of equal volumes. Cells that cross
/// the border of the shape raise the number. The sampling error falls faster than with purely
/// random points. The result depends only on the arguments.
std::vector<Vec3> PointsIn(const Zone& zone, int count, std::uint64_t seed);

/// Upright pose with the link's position and heading (direction of its x axis, seen from above).
Pose Levelled(const Pose& X_WB);

}  // namespace tera
