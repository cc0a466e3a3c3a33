#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tera {

/// Access to the files below a folder, and to no others.
///
/// Model   a valid path is relative, separated by `/`, without `..`, `.` or empty parts. It must
///         lead to a regular file whose real path, after resolution of all links, lies below the
///         folder's real path.
class ServedFolder {
 public:
  /// Throws InputError if the folder does not exist.
  explicit ServedFolder(const std::filesystem::path& folder);

  const std::filesystem::path& root() const { return root_; }
  /// Real path of a readable file, or nullopt.
  std::optional<std::filesystem::path> Find(std::string_view relative) const;
  /// Content of a file. Throws InputError unless a readable file exists.
  std::string Read(std::string_view relative) const;

 private:
  std::filesystem::path root_;
};

/// Bytes [begin, begin + length) of a file; fewer at its end or after a read error.
std::string ReadPart(const std::filesystem::path& file, std::uint64_t begin, std::size_t length);

}  // namespace tera
