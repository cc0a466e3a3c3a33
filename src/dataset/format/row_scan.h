#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"

namespace tera {

/// A row of a CSV file that could be read.
struct ScannedRow {
  int line = 0;
  TimeNs t_ns = 0;
  std::vector<double> values;  ///< without t_ns; none of a list of frames
  std::string filename;        ///< of a list of frames
};

enum class RowFault {
  kCutOff,     ///< a last line without an end
  kFields,     ///< too few or many fields, or no number
  kNotFinite,  ///< NaN or infinity
  kStamp       ///< t_ns no greater than in the row before
};

/// Reads a CSV file of a recording row by row, whatever its length. Times of the rows that it gives
/// increase.
class RowScan {
 public:
  using OnFault = std::function<void(RowFault fault, int line, const std::string& what)>;

  /// Refuses faults: throws InputError with file and line where the file cannot be read, where its
  /// first line is no header or names a column twice, and in Next at a faulty row.
  explicit RowScan(const std::filesystem::path& file);
  /// Goes on behind faulty rows, which it tells and leaves out.
  RowScan(const std::filesystem::path& file, OnFault on_fault);
  RowScan(const RowScan&) = delete;
  RowScan& operator=(const RowScan&) = delete;

  /// Without t_ns; of a list of frames `filename` alone.
  const std::vector<std::string>& columns() const { return columns_; }
  bool lists_frames() const { return lists_frames_; }
  /// The next row without fault; false at the end.
  bool Next(ScannedRow* row);
  /// Throws InputError about the row that Next gave last, before it about the header.
  [[noreturn]] void Fail(std::string_view finding) const;
  /// Throws InputError unless the columns are these, without t_ns; names the first that is missing.
  void RequireColumns(const std::vector<std::string>& columns) const;

 private:
  bool Read(ScannedRow* row);
  bool Tell(RowFault fault, const std::string& what) const;

  std::filesystem::path file_;
  std::ifstream stream_;
  OnFault on_fault_;
  std::string text_;
  int line_ = 1;
  bool lists_frames_ = false;
  std::optional<TimeNs> before_ns_;
  std::vector<std::string> columns_;
  std::vector<std::string_view> fields_;  ///< of `text_`
};

}  // namespace tera
