#pragma once

#include <filesystem>

namespace tera {

/// Writes a contact sheet of a recording as a PNG: cameras with depth, classes and instances, one
/// lidar scan from above, trajectories, and curves of all other sensors. Also writes a film (H.264)
/// of its cameras side by side. Missing channels are left out; without a camera there is no film.
/// Throws InputError if the recording cannot be read, or gnuplot or ffmpeg is not installed.
void WriteOverview(const std::filesystem::path& dataset, const std::filesystem::path& png,
                   const std::filesystem::path& mp4);

}  // namespace tera
