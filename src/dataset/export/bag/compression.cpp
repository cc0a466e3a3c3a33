#include "dataset/export/bag/compression.h"

#include <lz4frame.h>
#include <zstd.h>

#include "core/check.h"

namespace tera {
namespace {

/// A zstd level fast enough for the write speed of a disk.
constexpr int kZstdLevel = 1;

std::string ByZstd(std::string_view bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kZstdLevel);
  TERA_CHECK(!ZSTD_isError(size), ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

std::string ByLz4(std::string_view bytes) {
  LZ4F_preferences_t preferences = {};
  preferences.frameInfo.contentSize = bytes.size();
  preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
  std::string packed(LZ4F_compressFrameBound(bytes.size(), &preferences), '\0');
  const std::size_t size =
      LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), &preferences);
  TERA_CHECK(!LZ4F_isError(size), LZ4F_getErrorName(size));
  packed.resize(size);
  return packed;
}

}  // namespace

std::string_view NameOf(BagCompression compression) {
  switch (compression) {
    case BagCompression::kZstd:
      return "zstd";
    case BagCompression::kLz4:
      return "lz4";
    case BagCompression::kNone:
      return "";
  }
  return "";
}

std::string Compressed(BagCompression compression, std::string_view bytes) {
  switch (compression) {
    case BagCompression::kZstd:
      return ByZstd(bytes);
    case BagCompression::kLz4:
      return ByLz4(bytes);
    case BagCompression::kNone:
      return std::string(bytes);
  }
  return std::string(bytes);
}

}  // namespace tera
