#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace tera {

/// A bag's file compressed as a whole by zstd, unpacked for the lifetime of this object.
///
/// Model   written piece by piece into a file without a name in the folder for temporary files. The
///         system frees its space when this program ends, however it does. Content that expands
///         more than a thousandfold, or beyond the disk's free space, is refused.
/// Throws  InputError where it cannot be read or there is no room.
class UnpackedFile {
 public:
  explicit UnpackedFile(const std::filesystem::path& packed);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  /// Path for this program alone: a link in /proc to the unnamed file.
  const std::filesystem::path& path() const { return path_; }
  /// Damage of the packed bytes from some place on; the content before it is unpacked.
  const std::optional<std::string>& damage() const { return damage_; }
  /// Rewrites a message about this file as one about the packed file.
  std::string OfPacked(const std::string& message) const;

 private:
  void Unpack();
  void Write(std::string_view bytes);

  std::filesystem::path packed_, folder_, path_;
  int descriptor_ = -1;
  std::optional<std::string> damage_;
};

/// Whether a path is that of an UnpackedFile.
bool IsUnpackedFile(const std::filesystem::path& path);

/// Unpacked files for repeated reading, as an import does for each channel. Each is unpacked on
/// first use, and kept unchanged for the lifetime of this object.
class UnpackedFiles {
 public:
  const UnpackedFile& Of(const std::filesystem::path& packed);

 private:
  std::map<std::filesystem::path, UnpackedFile> files_;  ///< key: absolute path of the packed file
};

}  // namespace tera
