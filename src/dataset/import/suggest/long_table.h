#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"
#include "dataset/import/suggest/table_layout.h"

namespace tera {

/// A table that has one row for each value of each signal: time, signal, value.
struct LongForm {
  std::size_t signal = 0, value = 0;  ///< columns
  std::optional<std::size_t> unit;
  std::vector<std::string> signals;  ///< their names, in the order in which they come
};

/// The rows of one of several sensors that take turns in a table.
struct SourceGuess {
  std::string column, rule, remark;  ///< that numbers them; an item of `valid_if`; a line
  double first = 0;                  ///< its number
};
/// By a column that is named as an id and has a few numbers.
std::optional<SourceGuess> FindSources(const std::vector<NumbersOfColumn>& columns);

/// By the names of the columns (signal, name, channel, ...; value, reading, ...) and what they
/// hold.
std::optional<LongForm> FindLongForm(const CsvFile& csv,
                                     const std::vector<NumbersOfColumn>& columns);

std::vector<std::size_t> RowsOfSignal(const CsvFile& csv, const LongForm& form,
                                      const std::string& signal);

/// A channel for each signal, which takes its rows by `valid_if`: an encoder for the angle of a
/// joint, else a table. Empty where no signal has a number.
std::string SignalsYaml(const CsvFile& csv, const TableLayout& layout, const LongForm& form);

}  // namespace tera
