#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "dataset/files/checked_file.h"

namespace tera {

/// Writes an archive of files as POSIX ustar, without owners and with time 0, so that equal files
/// give equal bytes.
///
/// Source  IEEE Std 1003.1-2017, "pax", section "ustar Interchange Format".
class TarWriter {
 public:
  explicit TarWriter(const std::filesystem::path& path) : file_(path) {}

  /// Adds the file "folder/name". Throws InputError if a name exceeds the format's 155 and 100
  /// bytes.
  void Add(std::string_view folder, std::string_view name, std::string_view bytes);
  /// Space of a file with this many bytes.
  static std::int64_t SpaceOf(std::size_t bytes);
  /// The size including the bytes that Commit adds.
  std::int64_t bytes() const;
  void Commit();

 private:
  CheckedFile file_;
};

}  // namespace tera
