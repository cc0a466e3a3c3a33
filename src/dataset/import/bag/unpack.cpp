#include "dataset/import/bag/unpack.h"

#include <bzlib.h>
#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

#include "dataset/import/bag/bag_file.h"

namespace tera {
namespace {

constexpr std::size_t kStepBytes = std::size_t{1} << 20;

/// Enlarges `bytes` in steps to at most `most` + 1. The extra byte shows whether the content
/// exceeds `most`.
std::size_t Grow(std::string* bytes, std::uint64_t most) {
  const std::size_t had = bytes->size();
  const std::uint64_t step = std::clamp<std::uint64_t>(had, 1, kStepBytes * 64);
  bytes->resize(std::min<std::uint64_t>(had + std::max<std::uint64_t>(step, 4096), most + 1));
  return bytes->size() - had;
}

void RequireSize(std::uint64_t found, std::uint64_t declared) {
  if (found == declared) return;
  throw BadBytes{fmt::format("{} bytes are declared, the compressed bytes hold {}", declared,
                             found > declared ? "more" : fmt::format("only {}", found))};
}

[[noreturn]] void FailUnpacking(const char* library, const std::string& reason) {
  throw BadBytes{fmt::format("the bytes cannot be unpacked by {}: {}", library, reason)};
}

/// Decompresses a zstd stream to at most `most` + 1 bytes.
std::string ByZstd(std::string_view packed, std::uint64_t most) {
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                          &ZSTD_freeDStream);
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  std::string bytes;
  std::size_t left = 1;
  while (left != 0 || in.pos < in.size) {
    const std::size_t had = bytes.size();
    ZSTD_outBuffer out{nullptr, Grow(&bytes, most), 0};
    out.dst = bytes.data() + had;
    const std::size_t before = in.pos;
    left = ZSTD_decompressStream(stream.get(), &out, &in);
    bytes.resize(had + out.pos);
    if (ZSTD_isError(left)) FailUnpacking("zstd", ZSTD_getErrorName(left));
    if (bytes.size() > most) return bytes;
    if (left != 0 && in.pos == before && out.pos == 0) FailUnpacking("zstd", "they end too early");
  }
  return bytes;
}

}  // namespace

std::string UnpackedZstd(std::string_view packed, std::uint64_t size) {
  RequirePieceSize(size);
  std::string bytes = ByZstd(packed, size);
  RequireSize(bytes.size(), size);
  return bytes;
}

std::string UnpackedZstd(std::string_view packed) {
  std::string bytes = ByZstd(packed, kMostPieceBytes);
  RequirePieceSize(bytes.size());
  return bytes;
}

bool IsZstdFrame(std::string_view bytes) { return bytes.starts_with("\x28\xb5\x2f\xfd"); }

std::string UnpackedLz4(std::string_view packed, std::uint64_t size) {
  RequirePieceSize(size);
  LZ4F_dctx* raw = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION))) {
    FailUnpacking("lz4", "no memory");
  }
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      raw, &LZ4F_freeDecompressionContext);
  std::string bytes;
  std::size_t left = 1;
  while (left != 0) {
    const std::size_t had = bytes.size();
    std::size_t out = Grow(&bytes, size), in = packed.size();
    left = LZ4F_decompress(context.get(), bytes.data() + had, &out, packed.data(), &in, nullptr);
    bytes.resize(had + out);
    packed.remove_prefix(in);
    if (LZ4F_isError(left)) FailUnpacking("lz4", LZ4F_getErrorName(left));
    if (bytes.size() > size) break;
    if (left != 0 && in == 0 && out == 0) FailUnpacking("lz4", "they end too early");
  }
  RequireSize(bytes.size(), size);
  return bytes;
}

std::string UnpackedBzip2(std::string_view packed, std::uint64_t size) {
  RequirePieceSize(size);
  RequirePieceSize(packed.size());
  bz_stream stream = {};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) FailUnpacking("bzip2", "no memory");
  const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> end(&stream,
                                                                       &BZ2_bzDecompressEnd);
  stream.next_in = const_cast<char*>(packed.data());  // bzip2 does not write to its input
  stream.avail_in = static_cast<unsigned>(packed.size());
  std::string bytes;
  int status = BZ_OK;
  while (status == BZ_OK && bytes.size() <= size) {
    const std::size_t had = bytes.size(), room = Grow(&bytes, size);
    stream.next_out = bytes.data() + had;
    stream.avail_out = static_cast<unsigned>(room);
    const unsigned before = stream.avail_in;
    status = BZ2_bzDecompress(&stream);
    bytes.resize(had + room - stream.avail_out);
    const bool stands_still = stream.avail_in == before && bytes.size() == had;
    if (status == BZ_OK && stands_still) FailUnpacking("bzip2", "they end too early");
  }
  if (status != BZ_OK && status != BZ_STREAM_END) {
    FailUnpacking("bzip2", fmt::format("its status is {}", status));
  }
  RequireSize(bytes.size(), size);
  return bytes;
}

}  // namespace tera
