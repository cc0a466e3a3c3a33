#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace tera {

/// A bag's file that was compressed as a whole, NAME.zstd, unpacked into the folder for temporary
/// files as long as this lives.
///
/// Model   written piece by piece. Bytes that unpack to more than a thousand times as many, or to
///         more than that folder has room for, are not believed.
/// Throws  InputError where it cannot be read or there is no room.
class UnpackedFile {
 public:
  explicit UnpackedFile(const std::filesystem::path& packed);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  /// NAME in a folder of its own.
  const std::filesystem::path& path() const { return path_; }
  /// What is wrong with the packed bytes from some place on; what stands before it is there.
  const std::optional<std::string>& damage() const { return damage_; }
  /// A message about this file as one about the packed one.
  std::string OfPacked(const std::string& message) const;

 private:
  void Unpack();

  std::filesystem::path packed_, folder_, path_;
  std::optional<std::string> damage_;
};

}  // namespace tera
