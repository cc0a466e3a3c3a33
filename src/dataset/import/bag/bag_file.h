#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "dataset/import/bag/byte_cursor.h"

namespace tera {

/// A file that is read in pieces. Throws BadBytes for invalid content, and InputError if the file
/// cannot be opened or read.
class BagFile {
 public:
  explicit BagFile(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  /// Reads `count` bytes from offset `at`. Throws BadBytes if the file is too short.
  std::string Read(std::uint64_t at, std::uint64_t count);
  /// Throws BadBytes if fewer than `count` bytes follow offset `at`.
  void Require(std::uint64_t at, std::uint64_t count) const;

 private:
  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
};

/// Size limit of a chunk or message. A larger declared size is treated as damage.
inline constexpr std::uint64_t kMostPieceBytes = std::uint64_t{1} << 30;
void RequirePieceSize(std::uint64_t bytes);

}  // namespace tera
