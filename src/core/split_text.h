#pragma once

#include <string_view>
#include <vector>

namespace tera {

/// Fills `parts` with the substrings of `text` between separators. Empty substrings count. The
/// overwritten vector keeps its memory.
inline void SplitAt(char separator, std::string_view text, std::vector<std::string_view>* parts) {
  parts->clear();
  for (;;) {
    const std::size_t end = text.find(separator);
    parts->push_back(text.substr(0, end));
    if (end == std::string_view::npos) return;
    text.remove_prefix(end + 1);
  }
}

inline std::vector<std::string_view> PartsOf(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  SplitAt(separator, text, &parts);
  return parts;
}

}  // namespace tera
