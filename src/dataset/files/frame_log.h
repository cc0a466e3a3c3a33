#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/time.h"

namespace tera {

/// Log of complete frames, from which a killed run can resume.
///
/// Model   one text line for each complete frame, appended when its last file has its name: channel
///         folder, t_ns, then size and name of each file. A line counts if it ends in a newline and
///         every file has that size. The log exists only in the incomplete directory. Append is
///         thread-safe.
class FrameLog {
 public:
  struct File {
    std::string name;  ///< relative to the dataset
    std::int64_t bytes = 0;
  };

  /// Reads the log of an earlier run in `root`, if there is one, and continues it.
  explicit FrameLog(const std::filesystem::path& root);
  FrameLog(const FrameLog&) = delete;
  FrameLog& operator=(const FrameLog&) = delete;
  ~FrameLog();

  /// Whether the frame was complete when this log was opened.
  bool WasWhole(const std::string& folder, TimeNs t_ns) const;
  void Append(const std::string& folder, TimeNs t_ns, const std::vector<File>& files);
  /// Closes and deletes the log.
  void Remove();

 private:
  void Load(const std::filesystem::path& root);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::map<std::string, std::set<TimeNs>> whole_;
};

}  // namespace tera
