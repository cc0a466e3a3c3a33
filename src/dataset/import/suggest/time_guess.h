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
  /// The lines of the longest part of a file whose times begin anew in between, as where a logger
  /// was started anew; 0: from the first, to the last.
  int first_line = 0, last_line = 0;
  std::string parts;  ///< remarks on them
};

/// By names that say time, dates, and sizes of an epoch; never by a column that always increases
/// alone. `rows` are those to look at, `columns` all of the table with the numbers of these rows.
TimeGuess GuessTime(const CsvFile& csv, const std::vector<std::size_t>& rows,
                    const std::vector<NumbersOfColumn>& columns, bool has_header);

}  // namespace tera
