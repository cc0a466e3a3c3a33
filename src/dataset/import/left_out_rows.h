#pragma once

#include <cstdint>
#include <string>

namespace tera {

/// What was left out of a file because it could not be read.
struct LeftOutRows {
  std::int64_t count = 0;
  std::string first;  ///< what was wrong with the first of them, with its place

  void Add(const std::string& fault) {
    if (count++ == 0) first = fault;
  }
};

}  // namespace tera
