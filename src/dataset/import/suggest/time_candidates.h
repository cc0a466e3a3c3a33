#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// A possible interpretation of columns as time.
struct TimeCandidate {
  std::string time;                  ///< such as "{column: t, unit: s}"
  std::string remark;                ///< remark that follows it
  std::vector<std::string> columns;  ///< columns in use; the last one changes most often
  bool is_absolute = false;          ///< counts from an epoch
  bool to_fill_in = false;           ///< `time` is incomplete and the user must complete it
};

/// Finds candidates by names, dates, and numbers large enough to count from an epoch. The most
/// certain candidate is first. Examines only `rows`; `columns` holds all columns with the numbers
/// of these rows.
std::vector<TimeCandidate> FindTimeCandidates(const CsvFile& csv,
                                              const std::vector<std::size_t>& rows,
                                              const std::vector<NumbersOfColumn>& columns,
                                              bool has_header);

/// True if a column name suggests a time.
bool NamesTime(std::string_view name);

}  // namespace tera
