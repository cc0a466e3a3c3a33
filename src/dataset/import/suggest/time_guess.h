#pragma once

#include <string>
#include <vector>

#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// The guessed time of a table.
struct TimeGuess {
  /// "time: {column: t, unit: s}\n" with its companions. For an unknown time, a `time:` placeholder
  /// that the import refuses, with a remark on the observations.
  std::string yaml;
  std::vector<std::string> columns;  ///< columns with the time
  std::vector<TimeNs> t_ns;          ///< row times; empty unless all are known
  /// The `valid_if` item that excludes rows with a repeated time; empty without any.
  std::string rule;
  /// Lines of the longest part of a file with restarting times, as from a restarted logger; 0: from
  /// the first, to the last.
  int first_line = 0, last_line = 0;
  std::string parts;  ///< remarks on the parts
};

/// Guesses the time by names, dates, and magnitudes of an epoch, never by a monotonic column alone.
/// `rows` are those to examine; `columns` are all columns with the numbers of these rows.
TimeGuess GuessTime(const CsvFile& csv, const std::vector<std::size_t>& rows,
                    const std::vector<NumbersOfColumn>& columns, bool has_header);

}  // namespace tera
