#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tera {

/// Decompress chunks and messages. Memory grows with the actual content, not with the declared
/// size. Throw BadBytes for bad data, or where the result has not the declared `size`.
std::string UnpackedZstd(std::string_view packed, std::uint64_t size);
std::string UnpackedLz4(std::string_view packed, std::uint64_t size);
std::string UnpackedBzip2(std::string_view packed, std::uint64_t size);

/// Decompresses a zstd frame, with or without a declared size, up to kMostPieceBytes.
std::string UnpackedZstd(std::string_view packed);
bool IsZstdFrame(std::string_view bytes);

}  // namespace tera
