#pragma once

#include <cstdint>
#include <string>

namespace tera {

/// Unreadable rows that were left out of a file.
struct LeftOutRows {
  std::int64_t count = 0;
  std::string first;  ///< fault of the first row, with its place

  void Add(const std::string& fault) {
    if (count++ == 0) first = fault;
  }
};

}  // namespace tera
