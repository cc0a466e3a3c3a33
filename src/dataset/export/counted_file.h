#pragma once

#include <filesystem>
#include <string_view>

#include "dataset/files/checked_file.h"

namespace tera {

/// A large file whose header states the length of the rest. The rest is written first to a
/// temporary file and joined to the header at the end.
class CountedFile {
 public:
  explicit CountedFile(const std::filesystem::path& path);

  void Append(std::string_view bytes) { rest_.Append(bytes); }
  /// Writes the file.
  void Commit(std::string_view header);

 private:
  std::filesystem::path path_;
  CheckedFile rest_;
};

}  // namespace tera
