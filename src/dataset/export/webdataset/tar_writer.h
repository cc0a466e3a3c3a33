#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "dataset/files/checked_file.h"

namespace tera {

/// An archive of files as POSIX ustar: without owners and with time 0, so that the same files are
/// the same bytes.
///
/// Source  IEEE Std 1003.1-2017, "pax", section "ustar Interchange Format".
class TarWriter {
 public:
  explicit TarWriter(const std::filesystem::path& path) : file_(path) {}

  /// The file "folder/name". Throws InputError where a name is longer than the format has room for:
  /// 155 and 100 bytes.
  void Add(std::string_view folder, std::string_view name, std::string_view bytes);
  /// What a file of so many bytes takes.
  static std::int64_t SpaceOf(std::size_t bytes);
  /// The size with the bytes that Commit adds.
  std::int64_t bytes() const;
  void Commit();

 private:
  CheckedFile file_;
};

}  // namespace tera
