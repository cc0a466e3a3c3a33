#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace tera {

/// A bag's file that was compressed as a whole by zstd, unpacked as long as this lives.
///
/// Model   written piece by piece into a file without a name on the disk of the folder for
///         temporary files: the system takes its room back when this program ends, however it does.
///         Bytes that unpack to more than a thousand times as many, or to more than that disk has
///         room for, are not believed.
/// Throws  InputError where it cannot be read or there is no room.
class UnpackedFile {
 public:
  explicit UnpackedFile(const std::filesystem::path& packed);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  /// The path by which this program, and no other, opens it: a link in /proc to no name.
  const std::filesystem::path& path() const { return path_; }
  /// What is wrong with the packed bytes from some place on; what stands before it is there.
  const std::optional<std::string>& damage() const { return damage_; }
  /// A message about this file as one about the packed one.
  std::string OfPacked(const std::string& message) const;

 private:
  void Unpack();
  void Write(std::string_view bytes);

  std::filesystem::path packed_, folder_, path_;
  int descriptor_ = -1;
  std::optional<std::string> damage_;
};

/// Whether a path is that of such a file.
bool IsUnpackedFile(const std::filesystem::path& path);

/// The unpacked files of those who read bags more than once, as an import does for each channel:
/// each is unpacked when it is first asked for and is kept, as it was then, as long as this lives.
class UnpackedFiles {
 public:
  const UnpackedFile& Of(const std::filesystem::path& packed);

 private:
  std::map<std::filesystem::path, UnpackedFile> files_;  ///< by the packed ones' absolute paths
};

}  // namespace tera
