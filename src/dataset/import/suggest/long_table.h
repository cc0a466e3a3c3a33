#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"
#include "dataset/import/suggest/table_layout.h"

namespace tera {

/// A long table: each row holds the time, the name of a signal and a value.
struct LongForm {
  std::size_t signal = 0, value = 0;  ///< column indices
  std::optional<std::size_t> unit;
  std::vector<std::string> signals;  ///< signal names in order of appearance
};

/// A table in which rows of several sensors alternate: how to select the rows of one sensor.
struct SourceGuess {
  std::string column, rule, remark;  ///< column with the sensor's id; item of `valid_if`; line with
                                     ///< a remark
  double first = 0;                  ///< id of the selected sensor
};
/// Finds a column that is named like an id and has few different values.
std::optional<SourceGuess> FindSources(const std::vector<NumbersOfColumn>& columns);

/// Detects a long table by column names (signal, name, channel, ...; value, reading, ...) and
/// content.
std::optional<LongForm> FindLongForm(const CsvFile& csv,
                                     const std::vector<NumbersOfColumn>& columns);

std::vector<std::size_t> RowsOfSignal(const CsvFile& csv, const LongForm& form,
                                      const std::string& signal);

/// One channel per signal, which selects its rows by `valid_if`. A joint angle becomes an encoder,
/// any other signal a table. Empty if no signal has numbers.
std::string SignalsYaml(const CsvFile& csv, const TableLayout& layout, const LongForm& form);

}  // namespace tera
