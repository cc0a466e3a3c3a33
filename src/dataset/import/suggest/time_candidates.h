#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// A way to read a table's time.
struct TimeCandidate {
  std::string time;                  ///< "{column: t, unit: s}"
  std::string remark;                ///< behind it
  std::vector<std::string> columns;  ///< the last one is the one that changes most
  bool is_absolute = false;          ///< counts from an epoch
  bool to_fill_in = false;           ///< `time` is not whole
};

/// By names that say time, dates, and sizes of an epoch, the surest first. `rows` are those to look
/// at, `columns` all of the table with the numbers of these rows.
std::vector<TimeCandidate> FindTimeCandidates(const CsvFile& csv,
                                              const std::vector<std::size_t>& rows,
                                              const std::vector<NumbersOfColumn>& columns,
                                              bool has_header);

/// Whether a name says that a column is a time.
bool NamesTime(std::string_view name);

}  // namespace tera
