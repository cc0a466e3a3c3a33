#include "dataset/import/bag/bag_file.h"

#include <fmt/format.h>

#include <cerrno>

#include "core/error.h"
#include "dataset/files/checked_file.h"

namespace tera {

BagFile::BagFile(const std::filesystem::path& path) : path_(path) {
  std::error_code status;
  size_ = std::filesystem::file_size(path, status);
  if (status) FailFile(path, "reading", status.value());
  stream_.open(path, std::ios::binary);
  if (!stream_) FailFile(path, "reading", errno);
}

void BagFile::Require(std::uint64_t at, std::uint64_t count) const {
  if (at > size_ || count > size_ - at) {
    throw BadBytes{fmt::format("{} bytes are declared, but the file has only {} more bytes", count,
                               at > size_ ? 0 : size_ - at)};
  }
}

std::string BagFile::Read(std::uint64_t at, std::uint64_t count) {
  Require(at, count);
  RequirePieceSize(count);
  std::string bytes(count, '\0');
  stream_.seekg(static_cast<std::streamoff>(at));
  stream_.read(bytes.data(), static_cast<std::streamsize>(count));
  if (!stream_) FailFile(path_, "reading", errno);
  return bytes;
}

void RequirePieceSize(std::uint64_t bytes) {
  if (bytes <= kMostPieceBytes) return;
  throw BadBytes{fmt::format("a size of {} bytes is declared; a chunk or message has at most {}",
                             bytes, kMostPieceBytes)};
}

}  // namespace tera
