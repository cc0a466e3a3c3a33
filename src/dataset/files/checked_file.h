#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace tera {

/// A file that is written under a temporary name and gets its own name when complete.
///
/// Every write, the close and the rename are checked. A failure is an InputError with the file, the
/// cause and the remedy (disk full, no permission, no such folder).
class CheckedFile {
 public:
  explicit CheckedFile(const std::filesystem::path& path);
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;
  /// Removes the temporary file unless Commit or Leave was called.
  ~CheckedFile();

  void Append(std::string_view bytes);
  /// Passes the buffer to the system.
  void Flush();
  /// Writes the buffer, closes, and renames the file.
  void Commit();
  /// Keeps the temporary file if Commit was not called, with as much as the disk takes. No call may
  /// follow.
  void Leave();
  std::int64_t bytes() const { return bytes_; }
  const std::filesystem::path& path() const { return path_; }
  /// Path for another program that writes instead of Append, before Commit.
  const std::filesystem::path& temporary() const { return temporary_; }

 private:
  /// Writes to the system.
  void Write(std::string_view bytes);

  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
  bool committed_ = false, left_ = false;
  std::string buffer_;
  std::int64_t bytes_ = 0;
};

/// Suffix of temporary names.
inline constexpr std::string_view kPartSuffix = ".part";

/// Writes `bytes` as the file at `path`, through a temporary name.
void WriteWholeFile(const std::filesystem::path& path, std::string_view bytes);

/// Bytes of a file. Throws InputError if it cannot be read.
std::string ReadWholeFile(const std::filesystem::path& path);

/// Creates a folder with its parents. Throws InputError.
void MakeFolder(const std::filesystem::path& path);

/// Creates a missing folder with its parents, and checks that files can be created in it. Throws
/// InputError.
void MakeWritableFolder(const std::filesystem::path& path);

/// The InputError for a system call on `path` that failed with `error_number`.
[[noreturn]] void FailFile(const std::filesystem::path& path, const std::string& doing,
                           int error_number);

}  // namespace tera
