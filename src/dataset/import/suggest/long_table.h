#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"
#include "dataset/import/suggest/table_layout.h"

namespace tera {

/// A long table, with one row for each value of each signal: time, signal, value.
struct LongForm {
  std::size_t signal = 0, value = 0;  ///< columns
  std::optional<std::size_t> unit;
  std::vector<std::string> signals;  ///< names in order of appearance
};

/// The rows of one of several sensors that alternate in a table.
struct SourceGuess {
  std::string column, rule, remark;  ///< the sensors' id column; an item of `valid_if`; a line
  double first = 0;                  ///< its id
};
/// Detects a column with an id name and few values.
std::optional<SourceGuess> FindSources(const std::vector<NumbersOfColumn>& columns);

/// Detects a long table by the columns' names (signal, name, channel, ...; value, reading, ...) and
/// contents.
std::optional<LongForm> FindLongForm(const CsvFile& csv,
                                     const std::vector<NumbersOfColumn>& columns);

std::vector<std::size_t> RowsOfSignal(const CsvFile& csv, const LongForm& form,
                                      const std::string& signal);

/// A channel for each signal, which selects its rows by `valid_if`: an encoder for a joint's angle,
/// else a table. Empty if no signal has a number.
std::string SignalsYaml(const CsvFile& csv, const TableLayout& layout, const LongForm& form);

}  // namespace tera
