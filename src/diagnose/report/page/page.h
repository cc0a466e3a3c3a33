#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/html.h"

// Building blocks of report pages.

namespace tera {

/// A page without network or scripts, for light and dark screens and for paper.
std::string Page(const std::string& title, const std::string& body);

/// An HTML table. Columns whose heading starts with '>' contain numbers.
class Table {
 public:
  explicit Table(const std::vector<std::string>& headings);
  /// `cells` are HTML.
  void Row(const std::vector<std::string>& cells);
  /// The table as HTML; empty without rows.
  std::string Take() const { return has_rows_ ? html_ + "</table></div>\n" : ""; }

 private:
  std::string html_;
  std::vector<std::string> classes_;
  bool has_rows_ = false;
};

std::string Code(std::string_view text);

}  // namespace tera
