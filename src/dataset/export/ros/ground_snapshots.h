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

/// The layer that grid map programs draw.
inline constexpr std::string_view kElevationLayer = "elevation";

/// A recording's ground rasters at one time, by their grid map layers: elevation, change,
/// mass_change, density, soil_class.
struct GroundSnapshot {
  TimeNs t_ns = 0;
  std::map<std::string, std::filesystem::path> layers;
};

/// The snapshots in truth/terrain, in order of time; none without the folder. The end's time is the
/// recording's duration.
std::vector<GroundSnapshot> GroundSnapshotsOf(const Recording& recording);

/// A snapshot as grid map in the world, with the stamp `stamp_ns`.
///
/// Throws  InputError if a raster cannot be read or has another extent than the others.
ros::GridMap GridMapOf(const GroundSnapshot& snapshot, TimeNs stamp_ns, const ReadGround& read);

}  // namespace tera
