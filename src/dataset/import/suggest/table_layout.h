#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// How a table is written as far as its keys `csv:` say so.
struct GivenForm {
  CsvForm form;
  std::set<std::string> keys;  ///< which of them are there
};

/// By key.path=value texts of `csv:`; others are a fault.
GivenForm GivenFormOf(const std::vector<std::string>& overrides);

/// How a foreign table is written.
struct TableLayout {
  CsvForm form;
  /// The texts in the line of units behind the names, column by column; empty: there is none.
  std::vector<std::string> units;
  char found_separator = ',';  ///< by CsvFile itself

  /// "csv: {...}\n" with what CsvFile does not find by itself, or nothing.
  std::string Yaml() const;
};

/// Finds the largest block of rows of one form among the first lines, and the names before it.
/// It does not look for what is `given`. Nothing where there is no such block.
std::optional<TableLayout> FindTableLayout(std::string_view text, const GivenForm& given);

/// Numbers of all columns in these rows.
std::vector<NumbersOfColumn> NumbersOf(const CsvFile& csv, const TableLayout& layout,
                                       const std::vector<std::size_t>& rows);

}  // namespace tera
