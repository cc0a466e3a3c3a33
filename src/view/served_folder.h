#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tera {

/// The files below a folder, and no others.
///
/// Model   a relative path by `/`, without `..`, `.` or empty parts, to a regular file whose real
/// place, all links
///         followed, is below the folder's real place.
class ServedFolder {
 public:
  /// Throws InputError where the folder is not there.
  explicit ServedFolder(const std::filesystem::path& folder);

  const std::filesystem::path& root() const { return root_; }
  /// The real place of a file, or nothing where there is none that may be read.
  std::optional<std::filesystem::path> Find(std::string_view relative) const;
  /// All of a file. Throws InputError where there is none that may be read.
  std::string Read(std::string_view relative) const;

 private:
  std::filesystem::path root_;
};

/// Bytes [begin, begin + length) of a file; fewer where it ends before or cannot be read.
std::string ReadPart(const std::filesystem::path& file, std::uint64_t begin, std::size_t length);

}  // namespace tera
