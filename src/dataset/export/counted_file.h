#pragma once

#include <filesystem>
#include <string_view>

#include "dataset/files/checked_file.h"

namespace tera {

/// A large file whose header contains the length of the data after it. The data is collected in a
/// temporary file and appended to the header at the end.
class CountedFile {
 public:
  explicit CountedFile(const std::filesystem::path& path);

  void Append(std::string_view bytes) { rest_.Append(bytes); }
  /// Writes the header and the data.
  void Commit(std::string_view header);

 private:
  std::filesystem::path path_;
  CheckedFile rest_;
};

}  // namespace tera
