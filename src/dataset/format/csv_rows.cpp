#include "dataset/format/csv_rows.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "core/check.h"

namespace tera {

std::string TableHeader(const std::vector<std::string>& columns) {
  std::string header = "t_ns";
  for (const std::string& column : columns) header += ',' + column;
  return header;
}

std::string RowText(const RowSample& row) {
  std::string text = fmt::format("{}", row.t_ns);
  for (const double value : row.values) {
    TERA_CHECK(std::isfinite(value), text);
    fmt::format_to(std::back_inserter(text), ",{}", value);
  }
  return text + '\n';
}

std::string FrameRowText(TimeNs t_ns, std::string_view filename) {
  return fmt::format("{},{}\n", t_ns, filename);
}

}  // namespace tera
