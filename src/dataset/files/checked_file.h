#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace tera {

/// A file that is written under a temporary name and renamed when complete.
///
/// Each write, the close and the rename are checked. A failure throws InputError with the file, the
/// cause (such as a full disk) and a remedy.
class CheckedFile {
 public:
  explicit CheckedFile(const std::filesystem::path& path);
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;
  /// Deletes the temporary file unless Commit or Leave was called.
  ~CheckedFile();

  void Append(std::string_view bytes);
  /// Passes buffered bytes to the operating system.
  void Flush();
  /// Writes buffered bytes, closes the file and renames it.
  void Commit();
  /// Closes the file and keeps it under its temporary name, with as many bytes as the disk holds.
  /// Does nothing after Commit. No other call may follow.
  void Leave();
  std::int64_t bytes() const { return bytes_; }
  const std::filesystem::path& path() const { return path_; }
  /// Path for another program that writes the file before Commit, instead of Append.
  const std::filesystem::path& temporary() const { return temporary_; }

 private:
  /// Writes to the operating system, without the buffer.
  void Write(std::string_view bytes);

  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
  bool committed_ = false, left_ = false;
  std::string buffer_;
  std::int64_t bytes_ = 0;
};

inline constexpr std::string_view kPartSuffix = ".part";

/// Writes a whole file through a temporary name.
void WriteWholeFile(const std::filesystem::path& path, std::string_view bytes);

/// Content of a file. Throws InputError if it cannot be read.
std::string ReadWholeFile(const std::filesystem::path& path);

/// Creates a folder and its parents. Throws InputError on failure.
void MakeFolder(const std::filesystem::path& path);

/// Creates a folder and its parents unless they exist, and checks that files can be created in it.
/// Throws InputError on failure.
void MakeWritableFolder(const std::filesystem::path& path);

/// Throws InputError for a system call on `path` that failed with `error_number`.
[[noreturn]] void FailFile(const std::filesystem::path& path, const std::string& doing,
                           int error_number);

}  // namespace tera
