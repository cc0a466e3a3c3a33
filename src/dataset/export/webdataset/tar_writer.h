#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "dataset/files/checked_file.h"

namespace tera {

/// Writes a POSIX ustar archive. Owners are absent and times are 0, so equal content gives equal
/// bytes.
///
/// Source  IEEE Std 1003.1-2017, "pax", section "ustar Interchange Format".
class TarWriter {
 public:
  explicit TarWriter(const std::filesystem::path& path) : file_(path) {}

  /// Adds the file "folder/name". Throws InputError if the folder exceeds 155 bytes or the name
  /// exceeds 100, the limits of the format.
  void Add(std::string_view folder, std::string_view name, std::string_view bytes);
  /// Bytes that a file of this size occupies in the archive.
  static std::int64_t SpaceOf(std::size_t bytes);
  /// Size of the archive, including the end blocks that Commit adds.
  std::int64_t bytes() const;
  void Commit();

 private:
  CheckedFile file_;
};

}  // namespace tera
