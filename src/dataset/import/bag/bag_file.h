#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "dataset/import/bag/byte_cursor.h"

namespace tera {

/// A file read piece by piece. Bad content throws BadBytes; a file that cannot be opened or read
/// throws InputError.
class BagFile {
 public:
  explicit BagFile(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  /// Reads `count` bytes from `at` on; missing bytes are a fault.
  std::string Read(std::uint64_t at, std::uint64_t count);
  /// Throws where the file holds fewer than `count` bytes from `at` on.
  void Require(std::uint64_t at, std::uint64_t count) const;

 private:
  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
};

/// Most bytes of a chunk or message. A greater declared size counts as damage, as does one that
/// exceeds the memory.
inline constexpr std::uint64_t kMostPieceBytes = std::uint64_t{1} << 30;
void RequirePieceSize(std::uint64_t bytes);

}  // namespace tera
