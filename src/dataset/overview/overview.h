#pragma once

#include <filesystem>

namespace tera {

/// A contact sheet of a recording as a PNG: cameras with depth, classes and instances, one lidar
/// scan from above, trajectories, curves of the numbers of all other sensors; and a film (H.264) of
/// its cameras side by side. Channels that the recording lacks are left out; without any camera
/// there is no film. Throws InputError if the recording cannot be read, or gnuplot or ffmpeg is not
/// installed.
void WriteOverview(const std::filesystem::path& dataset, const std::filesystem::path& png,
                   const std::filesystem::path& mp4);

}  // namespace tera
