#pragma once

#include <cstdint>
#include <string>

namespace tera {

/// Count of unreadable rows that were skipped in a file.
struct LeftOutRows {
  std::int64_t count = 0;
  std::string first;  ///< message about the first of them, with its place

  void Add(const std::string& fault) {
    if (count++ == 0) first = fault;
  }
};

}  // namespace tera
