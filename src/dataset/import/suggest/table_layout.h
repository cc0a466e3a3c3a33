#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/csv_file.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// The part of a table's syntax that the user gives by `csv:` keys.
struct GivenForm {
  CsvForm form;
  std::set<std::string> keys;  ///< keys that are given
};

/// Reads texts `csv.key=value`. Any other key is a fault.
GivenForm GivenFormOf(const std::vector<std::string>& overrides);

struct TableLayout {
  CsvForm form;
  /// Texts in the line of units that follows the names, by column; empty without such a line.
  std::vector<std::string> units;
  char found_separator = ',';  ///< separator that CsvFile would choose

  /// Line "csv: {...}\n" with the keys that CsvFile cannot find by itself; empty if there are none.
  std::string Yaml() const;
};

/// Finds the largest block of uniform rows in the first lines, and the line of names above it. Keys
/// in `given` are not searched. Returns nullopt if there is no such block.
std::optional<TableLayout> FindTableLayout(std::string_view text, const GivenForm& given);

std::vector<NumbersOfColumn> NumbersOf(const CsvFile& csv, const TableLayout& layout,
                                       const std::vector<std::size_t>& rows);

}  // namespace tera
