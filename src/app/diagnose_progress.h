#pragma once

#include <chrono>
#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// Follows a diagnosis on a terminal: a line for each block, which first says that it is being
/// looked at, then what came of it and when. Says nothing where standard error is no terminal.
class DiagnoseProgress {
 public:
  explicit DiagnoseProgress(std::string machine);
  void Show(const BlockProgress& progress) const;

 private:
  std::string machine_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace tera
