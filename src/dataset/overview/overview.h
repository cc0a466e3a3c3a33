#pragma once

#include <filesystem>

namespace tera {

/// Writes a contact sheet of a recording as PNG, and a video (H.264) of its cameras side by side.
/// The sheet shows cameras with depth, classes and instances, a lidar scan from above,
/// trajectories, and curves of all other sensors. Missing channels are left out; without a camera
/// there is no video. Throws InputError if the recording cannot be read, or if gnuplot or ffmpeg is
/// not installed.
void WriteOverview(const std::filesystem::path& dataset, const std::filesystem::path& png,
                   const std::filesystem::path& mp4);

}  // namespace tera
