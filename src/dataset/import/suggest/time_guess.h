#pragma once

#include <string>
#include <vector>

#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// Guess of how a table gives the time.
struct TimeGuess {
  /// Line "time: {column: t, unit: s}\n" with related keys. For an unknown time, a placeholder that
  /// the import refuses, with a remark on what was observed.
  std::string yaml;
  std::vector<std::string> columns;  ///< columns that the time uses
  std::vector<TimeNs> t_ns;          ///< row times; empty unless every row has one
  /// Item of `valid_if` that excludes rows with a repeated time; empty if there are none.
  std::string rule;
  /// If the time restarts within the file, for example because the logger restarted: lines of the
  /// longest part without a restart. 0 means no limit.
  int first_line = 0, last_line = 0;
  std::string parts;  ///< remarks on these parts
};

/// Guesses from column names, dates, and numbers large enough to count from an epoch. That a column
/// increases is not sufficient. Examines only `rows`; `columns` holds all columns with the numbers
/// of these rows.
TimeGuess GuessTime(const CsvFile& csv, const std::vector<std::size_t>& rows,
                    const std::vector<NumbersOfColumn>& columns, bool has_header);

}  // namespace tera
