#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "dataset/import/bag/byte_cursor.h"

namespace tera {

/// A file that is read piece by piece. Faults are BadBytes but for a file that cannot be opened or
/// read, which is an InputError.
class BagFile {
 public:
  explicit BagFile(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  /// The bytes from `at` on; those that the file lacks are a fault.
  std::string Read(std::uint64_t at, std::uint64_t count);
  /// A fault where fewer than `count` bytes stand from `at` on.
  void Require(std::uint64_t at, std::uint64_t count) const;

 private:
  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
};

/// What a chunk or a message may hold at most: declared sizes beyond are taken as damage, and so
/// are those that would fill the memory.
inline constexpr std::uint64_t kMostPieceBytes = std::uint64_t{1} << 30;
void RequirePieceSize(std::uint64_t bytes);

}  // namespace tera
