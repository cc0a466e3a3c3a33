#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"

namespace tera {

/// Reads a CSV file of a recording row by row, whatever its length.
///
/// Every fault is an InputError with file and line: no header, a header without t_ns, a row with
/// too few or too many fields, a number that is none or not finite, times that do not increase, a
/// last line that was cut off.
class RowReader {
 public:
  explicit RowReader(const std::filesystem::path& file);

  /// Without t_ns; none of a list of frames.
  const std::vector<std::string>& columns() const { return columns_; }
  /// The file lists frames (t_ns,filename).
  bool lists_frames() const { return lists_frames_; }
  /// False at the end.
  bool Next(TimeNs* t_ns, std::vector<double>* values);
  /// About the row that Next gave last.
  [[noreturn]] void Fail(std::string_view finding) const;

 private:
  bool NextLine();

  std::filesystem::path path_;
  std::ifstream stream_;
  std::string text_;
  int line_ = 0;
  bool lists_frames_ = false, has_before_ = false;
  TimeNs before_ns_ = 0;
  std::vector<std::string> columns_;
};

}  // namespace tera
