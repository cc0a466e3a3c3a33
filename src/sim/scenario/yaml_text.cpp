#include "sim/scenario/yaml_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace tera {

std::string QuotedText(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

std::string NameText(const std::string& name) {
  const bool is_plain = std::ranges::all_of(
      name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
  return is_plain && !name.empty() ? name : QuotedText(name);
}

std::string PointText(const Vec2& p_m) { return fmt::format("[{:.3f}, {:.3f}]", p_m.x(), p_m.y()); }

std::string OutlineText(const std::vector<Vec2>& outline_m) {
  std::vector<std::string> corners;
  for (const Vec2& corner : outline_m) corners.push_back(PointText(corner));
  return fmt::format("[{}]", fmt::join(corners, ", "));
}

}  // namespace tera
