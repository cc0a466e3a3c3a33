#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace tera {

/// A file that is written under a temporary name and appears under its own when it is whole.
///
/// Every write, the close and the rename are checked; a failure is an InputError that says which
/// file, why, and what to do (disk full, no permission, no such folder).
class CheckedFile {
 public:
  explicit CheckedFile(const std::filesystem::path& path);
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;
  /// Without Commit or Leave, removes the temporary file.
  ~CheckedFile();

  void Append(std::string_view bytes);
  /// Hands what is buffered to the system.
  void Flush();
  /// Writes what is buffered, closes, and gives the file its name.
  void Commit();
  /// Without Commit before it, the temporary file stays, with as much as the disk takes. The last
  /// use of this.
  void Leave();
  std::int64_t bytes() const { return bytes_; }
  const std::filesystem::path& path() const { return path_; }
  /// Where another program may write instead of Append, before Commit.
  const std::filesystem::path& temporary() const { return temporary_; }

 private:
  /// To the system.
  void Write(std::string_view bytes);

  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
  bool committed_ = false, left_ = false;
  std::string buffer_;
  std::int64_t bytes_ = 0;
};

/// Ending of temporary names.
inline constexpr std::string_view kPartSuffix = ".part";

/// The whole of `bytes` as the file at `path`, by way of a temporary name.
void WriteWholeFile(const std::filesystem::path& path, std::string_view bytes);

/// Bytes of a file. Throws InputError if it cannot be read.
std::string ReadWholeFile(const std::filesystem::path& path);

/// Creates a folder with its parents. Throws InputError.
void MakeFolder(const std::filesystem::path& path);

/// Creates a folder with its parents where it is not there, and tries whether files can be created
/// in it. Throws InputError.
void MakeWritableFolder(const std::filesystem::path& path);

/// The InputError for a system call on `path` that failed with `error_number`.
[[noreturn]] void FailFile(const std::filesystem::path& path, const std::string& doing,
                           int error_number);

}  // namespace tera
