#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config.h"
#include "core/time.h"

namespace tera {

/// Files of frames, with their times.
struct StampedFiles {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;
  std::vector<TimeNs> times_ns;  ///< one per file
};

/// Reads the folder `files` and the file `times` of a channel. `times` has one time per line;
/// without it, the times are taken from file names. Files must end in one of `endings`, given in
/// lower case with the dot. They are sorted by name in natural order. `of` is the word for them in
/// messages, such as "scans". Faults are reported at `channel`.
StampedFiles ReadStampedFiles(const ConfigMap& channel,
                              std::initializer_list<std::string_view> endings, std::string_view of);

/// Time in a file name. The number of digits decides between ns, us, ms and s since 1970. A dot
/// marks seconds, as in "1403636579.763555". A name with too few digits gives nullopt.
std::optional<TimeNs> StampOfName(const std::filesystem::path& file);

}  // namespace tera
