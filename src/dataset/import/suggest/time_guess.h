#pragma once

#include <string>
#include <vector>

#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// The time that a table seems to have.
struct TimeGuess {
  /// "time: {column: t, unit: s}\n" and what goes with it; where the time is not known, a `time:`
  /// that the import refuses until it is filled in, with a remark of what was seen.
  std::string yaml;
  std::vector<std::string> columns;  ///< it is made of
  std::vector<TimeNs> t_ns;          ///< of the rows; empty where it is not known of all
  /// The item of `valid_if` that leaves out rows which repeat the time of the row before; empty
  /// where there are none.
  std::string rule;
};

/// By names that say time, dates, and sizes of an epoch; never by a column that always increases
/// alone. `rows` are those to look at, `columns` all of the table with the numbers of these rows.
TimeGuess GuessTime(const CsvFile& csv, const std::vector<std::size_t>& rows,
                    const std::vector<NumbersOfColumn>& columns, bool has_header);

}  // namespace tera
