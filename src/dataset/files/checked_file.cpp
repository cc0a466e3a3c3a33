#include "dataset/files/checked_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/check.h"
#include "core/error.h"

namespace tera {
namespace {

constexpr std::size_t kBufferBytes = 1 << 16;
constexpr int kFileMode = 0644;

std::string Remedy(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
      return "free space on that disk";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that you may write to";
    case ENOENT:
    case ENOTDIR:
      return "choose a path with folders as parents";
    default:
      return "check the disk and the path";
  }
}

[[noreturn]] void Fail(const std::filesystem::path& path, const std::string& doing,
                       int error_number, const std::string& remedy) {
  throw InputError(path.string(),
                   {FaultKind::kUnwritable,
                    fmt::format("{}: {}; {}", doing, std::strerror(error_number), remedy)});
}

}  // namespace

void FailFile(const std::filesystem::path& path, const std::string& doing, int error_number) {
  Fail(path, doing, error_number, Remedy(error_number));
}

CheckedFile::CheckedFile(const std::filesystem::path& path) : path_(path), temporary_(path) {
  temporary_ += kPartSuffix;
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kFileMode);
  if (descriptor_ < 0) FailFile(path_, "cannot be created", errno);
}

CheckedFile::~CheckedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!committed_ && !left_) ::unlink(temporary_.c_str());
}

void CheckedFile::Append(std::string_view bytes) {
  bytes_ += static_cast<std::int64_t>(bytes.size());
  if (bytes.size() >= kBufferBytes) {
    Flush();
    return Write(bytes);
  }
  buffer_ += bytes;
  if (buffer_.size() >= kBufferBytes) Flush();
}

void CheckedFile::Flush() {
  Write(buffer_);
  buffer_.clear();
}

void CheckedFile::Write(std::string_view bytes) {
  TERA_CHECK(descriptor_ >= 0, path_.string());
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) FailFile(path_, "cannot be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void CheckedFile::Commit() {
  Flush();
  const int status = ::close(std::exchange(descriptor_, -1));
  if (status != 0) FailFile(path_, "cannot be written", errno);
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) {
    FailFile(path_, "cannot be given its name", errno);
  }
  committed_ = true;
}

void CheckedFile::Leave() {
  if (descriptor_ < 0) return;
  left_ = true;
  try {
    Flush();
  } catch (const InputError&) {
    // The failure of the disk has already been reported.
  }
}

void WriteWholeFile(const std::filesystem::path& path, std::string_view bytes) {
  CheckedFile file(path);
  file.Append(bytes);
  file.Commit();
}

std::string ReadWholeFile(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    throw InputError(path.string(), {FaultKind::kUnreadable,
                                     fmt::format("cannot be read: {}; need a readable file",
                                                 std::strerror(errno))});
  }
  std::string bytes;
  std::error_code no_size;
  if (const auto size = std::filesystem::file_size(path, no_size); !no_size) bytes.reserve(size);
  char block[kBufferBytes];
  ssize_t count = 0;
  while ((count = ::read(descriptor, block, sizeof block)) > 0) bytes.append(block, count);
  const int error_number = errno;
  ::close(descriptor);
  if (count < 0) {
    throw InputError(path.string(), {FaultKind::kUnreadable,
                                     fmt::format("cannot be read: {}; need a readable file",
                                                 std::strerror(error_number))});
  }
  return bytes;
}

void MakeFolder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  const std::string doing = "folder cannot be created";
  // Parents are created too, so ENOENT means that the path does not allow folders.
  if (error.value() == ENOENT) Fail(path, doing, ENOENT, Remedy(EACCES));
  if (error) FailFile(path, doing, error.value());
}

void MakeWritableFolder(const std::filesystem::path& path) {
  MakeFolder(path);
  std::string name = (path / ".writable_XXXXXX").string();
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) FailFile(path, "cannot be written to", errno);
  ::close(descriptor);
  ::unlink(name.c_str());
}

}  // namespace tera
