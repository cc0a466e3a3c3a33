#pragma once

#include <filesystem>

#include "dataset/format/recording.h"

namespace tera {

/// A film (H.264, yuv420p, by the ffmpeg program) of all cameras side by side, colour above and
/// the first label channel that each has, classes as a rule, below, at the first camera's frame
/// rate; of the others the latest frame is shown. Writes nothing if there is no camera with frames.
/// Throws InputError if ffmpeg is not installed.
void WriteFilm(const Recording& recording, const std::filesystem::path& mp4);

}  // namespace tera
