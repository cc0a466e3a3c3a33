#pragma once

#include <cstdio>
#include <optional>
#include <string>

/// Foreign programs, and programs that check TERA's output.

namespace tera {

/// Standard output of a program; none if it fails.
inline std::optional<std::string> OutputOf(const std::string& command) {
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  char buffer[4096];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, n);
  return pclose(pipe) == 0 ? std::optional(text) : std::nullopt;
}

inline bool HasProgram(const std::string& name) {
  return OutputOf("command -v " + name + " 2>/dev/null").has_value();
}

}  // namespace tera
