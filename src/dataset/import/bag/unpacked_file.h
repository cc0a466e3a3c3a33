#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace tera {

/// A bag file that is compressed as a whole by zstd. It is decompressed for the lifetime of this
/// object.
///
/// Model   The content is written in pieces to an unnamed file in the folder for temporary files.
///         The system frees its space when the program ends for any reason. Content is refused if
///         it expands more than a thousandfold or exceeds the free disk space.
/// Throws  InputError if the file cannot be read or the space is insufficient.
class UnpackedFile {
 public:
  explicit UnpackedFile(const std::filesystem::path& packed);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  /// Path of the unnamed file, a link in /proc. Only this process can use it.
  const std::filesystem::path& path() const { return path_; }
  /// Message about damage in the compressed data. The content before the damage is decompressed.
  const std::optional<std::string>& damage() const { return damage_; }
  /// Replaces the temporary path in a message by the path of the compressed file.
  std::string OfPacked(const std::string& message) const;

 private:
  void Unpack();
  void Write(std::string_view bytes);

  std::filesystem::path packed_, folder_, path_;
  int descriptor_ = -1;
  std::optional<std::string> damage_;
};

/// True for a path that UnpackedFile::path returned.
bool IsUnpackedFile(const std::filesystem::path& path);

/// Cache of decompressed files. An import reads a file once per channel. A file is decompressed at
/// its first use.
class UnpackedFiles {
 public:
  const UnpackedFile& Of(const std::filesystem::path& packed);

 private:
  std::map<std::filesystem::path, UnpackedFile> files_;  ///< by absolute path of the compressed
                                                         ///< file
};

}  // namespace tera
