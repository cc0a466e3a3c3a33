#include "dataset/files/block_file.h"

#include <fmt/format.h>
#include <zstd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <memory>

#include "core/check.h"
#include "core/error.h"

namespace tera {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie");

constexpr std::string_view kMagic = "TERA blocks 1\n";
constexpr int kLevel = 6;  ///< zstd level; higher levels save little space
constexpr std::uint64_t kMostStream_bytes = 1u << 30;  ///< a greater length is a sign of damage
/// Largest expansion of a zstd frame: a block of 128 KiB takes at least 4 bytes.
constexpr std::uint64_t kMostOfAByte_bytes = 1u << 15;

[[noreturn]] void FailReading(const std::filesystem::path& path, int error_number) {
  throw InputError(path.string(),
                   {FaultKind::kUnreadable, fmt::format("cannot be read: {}; need a readable file",
                                                        std::strerror(error_number))});
}

std::string NumberBytes(std::size_t number) {
  TERA_CHECK(number <= kMostStream_bytes, number);
  const auto n = static_cast<std::uint32_t>(number);
  std::string bytes(sizeof n, '\0');
  std::memcpy(bytes.data(), &n, sizeof n);
  return bytes;
}

std::string Compressed(const std::string& stream) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                     &ZSTD_freeCCtx);
  TERA_CHECK(context != nullptr);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kLevel);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::string out(ZSTD_compressBound(stream.size()), '\0');
  const std::size_t size =
      ZSTD_compress2(context.get(), out.data(), out.size(), stream.data(), stream.size());
  TERA_CHECK(!ZSTD_isError(size), ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

}  // namespace

BlockFileWriter::BlockFileWriter(const std::filesystem::path& path, std::string_view header)
    : file_(path) {
  file_.Append(kMagic);
  file_.Append(NumberBytes(header.size()));
  file_.Append(header);
}

void BlockFileWriter::Append(const Block& block) {
  TERA_CHECK(!block.empty());
  file_.Append(NumberBytes(block.size()));
  for (const std::string& stream : block) {
    const std::string compressed = Compressed(stream);
    file_.Append(NumberBytes(compressed.size()));
    file_.Append(compressed);
  }
}

void BlockFileWriter::Commit() {
  file_.Append(NumberBytes(0));
  file_.Commit();
}

BlockFileReader::BlockFileReader(const std::filesystem::path& path)
    : path_(path), stream_(path, std::ios::binary) {
  if (!stream_) FailReading(path, errno);
  std::error_code error;
  left_ = std::filesystem::file_size(path, error);
  if (error) FailReading(path, error.value());
  if (left_ < kMagic.size() || Read(kMagic.size()) != kMagic) {
    Fail("is not a file of compressed blocks of version 1, or is damaged");
  }
  header_ = Read(ReadNumber());
}

std::optional<Block> BlockFileReader::Next() {
  if (at_end_) return std::nullopt;
  const std::uint32_t streams = ReadNumber();
  if (streams == 0) {
    if (left_ > 0) Fail("has extra bytes after its end");
    at_end_ = true;
    return std::nullopt;
  }
  if (streams > left_) Fail("is damaged");
  Block block;
  for (std::uint32_t s = 0; s < streams; ++s) {
    const std::string compressed = Read(ReadNumber());
    const unsigned long long size = ZSTD_getFrameContentSize(compressed.data(), compressed.size());
    if (size > kMostStream_bytes || size > kMostOfAByte_bytes * compressed.size()) {
      Fail("is damaged");
    }
    std::string& stream = block.emplace_back(size, '\0');
    if (ZSTD_decompress(stream.data(), size, compressed.data(), compressed.size()) != size) {
      Fail("is damaged");
    }
  }
  return block;
}

std::string BlockFileReader::Read(std::uint64_t bytes) {
  if (bytes > left_) Fail("is cut short");
  std::string read(bytes, '\0');
  stream_.read(read.data(), static_cast<std::streamsize>(bytes));
  if (!stream_) FailReading(path_, errno);
  left_ -= bytes;
  return read;
}

std::uint32_t BlockFileReader::ReadNumber() {
  std::uint32_t number = 0;
  std::memcpy(&number, Read(sizeof number).data(), sizeof number);
  return number;
}

void BlockFileReader::Fail(std::string_view finding) const {
  throw InputError(
      path_.string(),
      {FaultKind::kMalformed,
       fmt::format("{}; need the original file, from the same version of TERA", finding)});
}

}  // namespace tera
