#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tera {

/// Access to the files below a folder, and to no other files.
///
/// Model   A valid path is relative, with parts separated by `/`; no part is empty, `.` or `..`.
///         After all links are resolved, it must be a regular file below the real path of the
///         folder.
class ServedFolder {
 public:
  /// Throws InputError if the folder does not exist.
  explicit ServedFolder(const std::filesystem::path& folder);

  const std::filesystem::path& root() const { return root_; }
  /// Real path of a readable file; nullopt if the path is invalid or unreadable.
  std::optional<std::filesystem::path> Find(std::string_view relative) const;
  /// Content of a file. Throws InputError if the path is invalid or unreadable.
  std::string Read(std::string_view relative) const;

 private:
  std::filesystem::path root_;
};

/// Bytes [begin, begin + length) of a file. Fewer if the file ends earlier or a read fails.
std::string ReadPart(const std::filesystem::path& file, std::uint64_t begin, std::size_t length);

}  // namespace tera
