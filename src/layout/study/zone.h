#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/config/config.h"
#include "core/motion.h"

namespace tera {

/// Name of the zone around the machine, which every study has.
inline constexpr char kAroundZone[] = "around";

/// A box about the origin of its zone's pose.
struct ZoneBox {
  Vec3 size_m = Vec3::Ones();
};

/// An upright cylinder that stands on the origin of its zone's pose.
struct ZoneCylinder {
  double radius_m = 1, height_m = 1;
};

/// A prism over a polygon in x and y, corners in order, between two heights.
struct ZonePrism {
  std::vector<Vec2> corners_m;
  double low_m = 0, high_m = 1;
};

/// A part of space whose coverage is measured.
///
/// Frames  F the zone's frame: W, or a link of the machine. With `level`, F has the link's position
///         and heading and stands upright. Z the shape's own, at X_FZ.
struct Zone {
  std::string name;
  std::string frame = "W";  ///< "W" or a link's name
  bool level = true;
  std::string place = "study: zone";  ///< its position in the file, for messages
  bool on_ground = false;             ///< F stands on the ground below the link's origin
  Pose X_FZ = Pose::Identity();
  std::variant<ZoneBox, ZoneCylinder, ZonePrism> shape = ZoneBox{};
};

/// Reads a zone. Faults go to `config`; the caller checks the link's name.
Zone ReadZone(const ConfigMap& config);

double Volume_m3(const Zone& zone);
/// About `count` points in Z, one random point in each cell of equal volume, more if cells cross
/// the shape's border. The error of a share over them falls faster than with purely random points.
/// The points depend only on the arguments.
std::vector<Vec3> PointsIn(const Zone& zone, int count, std::uint64_t seed);

/// The upright pose at a link's position and heading, the direction of its x axis from above.
Pose Levelled(const Pose& X_WB);

}  // namespace tera
