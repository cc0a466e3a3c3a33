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

/// The layer that grid map viewers display as height.
inline constexpr std::string_view kElevationLayer = "elevation";

/// Ground rasters of a recording at one time, by grid map layer: elevation, change, mass_change,
/// density, soil_class.
struct GroundSnapshot {
  TimeNs t_ns = 0;
  std::map<std::string, std::filesystem::path> layers;
};

/// Snapshots in truth/terrain, in order of time; empty if the folder is absent. The final snapshot
/// has the time of the recording's end.
std::vector<GroundSnapshot> GroundSnapshotsOf(const Recording& recording);

/// Converts a snapshot to a grid map in the world frame.
///
/// Throws  InputError if a raster cannot be read or the extents of the rasters differ.
ros::GridMap GridMapOf(const GroundSnapshot& snapshot, TimeNs stamp_ns, const ReadGround& read);

}  // namespace tera
