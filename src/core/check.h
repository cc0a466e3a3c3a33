#pragma once

#include <fmt/format.h>

#include <string>

/// `TERA_CHECK(condition, values...)` checks an internal invariant, also in release builds. A
/// failure is a bug in TERA, never bad input. It throws InternalError with the condition, the
/// values, file and line.

namespace tera {

[[noreturn]] void FailCheck(const char* condition, const char* file, int line,
                            const std::string& values);

namespace internal {

template <typename... Values>
std::string JoinValues(const Values&... values) {
  std::string text;
  ((text += fmt::format(" {}", values)), ...);
  return text;
}

}  // namespace internal
}  // namespace tera

#define TERA_CHECK(condition, ...)                                  \
  do {                                                              \
    if (!(condition)) [[unlikely]] {                                \
      ::tera::FailCheck(#condition, __FILE__, __LINE__,             \
                        ::tera::internal::JoinValues(__VA_ARGS__)); \
    }                                                               \
  } while (false)
