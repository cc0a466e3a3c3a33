#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/export/ros/ground_squares.h"
#include "dataset/format/recording.h"
#include "dataset/ros/messages.h"

namespace tera {

/// The layer that programs of grid maps draw.
inline constexpr std::string_view kElevationLayer = "elevation";

/// The rasters that a recording keeps of its ground at one time, by their layers' names in a grid
/// map: elevation, change, mass_change, density, soil_class.
struct GroundSnapshot {
  TimeNs t_ns = 0;
  std::map<std::string, std::filesystem::path> layers;
};

/// Those of truth/terrain, in order of time; none where there is no such folder. The end's time is
/// the recording's duration.
std::vector<GroundSnapshot> GroundSnapshotsOf(const Recording& recording);

/// A snapshot as grid map in the world, its stamp `stamp_ns`.
///
/// Throws InputError where a raster cannot be read or lies otherwise than the others.
ros::GridMap GridMapOf(const GroundSnapshot& snapshot, TimeNs stamp_ns, const ReadGround& read);

}  // namespace tera
