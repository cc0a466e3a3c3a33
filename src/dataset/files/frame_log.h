#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/time.h"

namespace tera {

/// Log of complete frames, from which a stopped run resumes.
///
/// Model   One text line per frame: channel folder, t_ns, and size and name of each file. The line
///         is appended after the last file of the frame has its final name. A line is valid if it
///         ends in a newline and each file has the logged size. The log exists only in the
///         incomplete directory. Append is thread-safe.
class FrameLog {
 public:
  struct File {
    std::string name;  ///< relative to the dataset
    std::int64_t bytes = 0;
  };

  /// Opens the log in `root` for appending. Frames logged by an earlier run are read.
  explicit FrameLog(const std::filesystem::path& root);
  FrameLog(const FrameLog&) = delete;
  FrameLog& operator=(const FrameLog&) = delete;
  ~FrameLog();

  /// True if the frame was complete when this log was opened.
  bool WasWhole(const std::string& folder, TimeNs t_ns) const;
  void Append(const std::string& folder, TimeNs t_ns, const std::vector<File>& files);
  void Remove();

 private:
  void Load(const std::filesystem::path& root);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::map<std::string, std::set<TimeNs>> whole_;
};

}  // namespace tera
