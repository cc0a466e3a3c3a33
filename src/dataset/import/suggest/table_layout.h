#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// The part of a table's syntax in the keys `csv:`.
struct GivenForm {
  CsvForm form;
  std::set<std::string> keys;  ///< the given keys
};

/// From key.path=value texts of `csv:`; others are a fault.
GivenForm GivenFormOf(const std::vector<std::string>& overrides);

/// Syntax of a foreign table.
struct TableLayout {
  CsvForm form;
  /// The texts in the line of units after the names, by column; empty without such a line.
  std::vector<std::string> units;
  char found_separator = ',';  ///< CsvFile's own choice

  /// "csv: {...}\n" with the keys that CsvFile does not find itself, or nothing.
  std::string Yaml() const;
};

/// Finds the largest uniform block of rows among the first lines, and the names before it. Keys in
/// `given` are not searched. Nothing without such a block.
std::optional<TableLayout> FindTableLayout(std::string_view text, const GivenForm& given);

/// Numbers of all columns in these rows.
std::vector<NumbersOfColumn> NumbersOf(const CsvFile& csv, const TableLayout& layout,
                                       const std::vector<std::size_t>& rows);

}  // namespace tera
