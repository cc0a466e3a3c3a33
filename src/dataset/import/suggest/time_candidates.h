#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// A possible interpretation of a table's time.
struct TimeCandidate {
  std::string time;                  ///< "{column: t, unit: s}"
  std::string remark;                ///< follows it
  std::vector<std::string> columns;  ///< the last one changes most
  bool is_absolute = false;          ///< counts from an epoch
  bool to_fill_in = false;           ///< `time` is incomplete
};

/// Finds times by names, dates, and magnitudes of an epoch, the most certain first. `rows` are
/// those to examine; `columns` are all columns with the numbers of these rows.
std::vector<TimeCandidate> FindTimeCandidates(const CsvFile& csv,
                                              const std::vector<std::size_t>& rows,
                                              const std::vector<NumbersOfColumn>& columns,
                                              bool has_header);

/// Whether a name means a time.
bool NamesTime(std::string_view name);

}  // namespace tera
