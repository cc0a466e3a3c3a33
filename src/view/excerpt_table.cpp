#include <algorithm>
#include <string_view>

#include "view/excerpt_parts.h"

namespace tera {

std::string ThinnedTable(const std::string& csv, std::size_t most_rows) {
  std::vector<std::string_view> lines;
  for (std::size_t begin = 0; begin < csv.size();) {
    const std::size_t end = std::min(csv.find('\n', begin), csv.size());
    if (end > begin) lines.push_back(std::string_view(csv).substr(begin, end - begin));
    begin = end + 1;
  }
  if (lines.size() <= most_rows + 1) return csv;
  std::string thin;
  const auto add = [&](std::string_view line) { thin.append(line).append("\n"); };
  add(lines.front());
  const std::size_t rows = lines.size() - 1;
  for (std::size_t k = 0; k < most_rows; ++k) {
    add(lines[1 + k * (rows - 1) / std::max<std::size_t>(most_rows - 1, 1)]);
  }
  return thin;
}

}  // namespace tera
