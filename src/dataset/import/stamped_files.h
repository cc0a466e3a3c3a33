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

/// Files of frames and their times.
struct StampedFiles {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;
  std::vector<TimeNs> times_ns;  ///< one for each file
};

/// Reads a channel's `files`, a folder, and `times`, a file of one time a line. Without `times` the
/// names have the times. Files have one of `endings`, in small letters with their point, and come
/// in natural order of their names; `of` names them in faults, "scans". Faults go to `channel`.
StampedFiles ReadStampedFiles(const ConfigMap& channel,
                              std::initializer_list<std::string_view> endings, std::string_view of);

/// Time in a file's name. Digits are ns, us, ms or s since 1970, by their number; a point
/// marks seconds, as in "1403636579.763555". A name with fewer digits has no time.
std::optional<TimeNs> StampOfName(const std::filesystem::path& file);

}  // namespace tera
