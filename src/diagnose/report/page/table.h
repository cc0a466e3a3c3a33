#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "diagnose/search/block/block_diagnosis.h"

// Tables of report.html.

namespace tera {

/// An HTML table. Columns whose heading starts with '>' hold numbers.
class Table {
 public:
  explicit Table(const std::vector<std::string>& headings);
  /// Cells are HTML.
  void Row(const std::vector<std::string>& cells);
  std::string Take() const { return html_ + "</table></div>\n"; }

 private:
  std::string html_;
  std::vector<std::string> classes_;
};

std::string Code(std::string_view text);
/// A cell with a unit; empty for a plain number's.
std::string UnitCell(std::string_view unit);

/// The free parameters of findings, or the measures of findings without free parameters, under a
/// heading.
std::string ParameterTable(const std::vector<const Finding*>& findings);

}  // namespace tera
