#pragma once

#include <cstdint>
#include <filesystem>

#include "dataset/export/export_options.h"

/// Recordings in the formats of others: what each holds is in docs/reference/export.md.

namespace tera {

struct ExportReport {
  std::int64_t records = 0, files = 0, bytes = 0;
  std::int64_t messages = 0;  ///< of a bag, where a record becomes any number of them
  AbsentPictures absent;      ///< left out of a bag
};

/// Writes the recording `dataset` as the new folder `out`, in pieces: no more of it is in memory
/// than one record of each channel, the frames that threads work on, two a thread, and what the
/// format gathers before it writes.
///
/// Throws InputError where the recording cannot be read or has nothing for the format, and where
/// `out` is there already or cannot be written; then nothing is left behind but, with `resume` and
/// in a format that goes on by frames, the frames that are whole. What a stopped export has left is
/// refused without `resume`, and with it where it is of another one.
ExportReport Export(const std::filesystem::path& dataset, const std::filesystem::path& out,
                    const ExportOptions& options);

}  // namespace tera
