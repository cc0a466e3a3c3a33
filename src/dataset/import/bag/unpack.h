#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tera {

/// Decompress chunks and messages. The memory in use grows with the real content, not with the
/// declared size. Throw BadBytes for invalid data and if the result does not have the declared
/// `size`.
std::string UnpackedZstd(std::string_view packed, std::uint64_t size);
std::string UnpackedLz4(std::string_view packed, std::uint64_t size);
std::string UnpackedBzip2(std::string_view packed, std::uint64_t size);

/// Decompresses a zstd frame of up to kMostPieceBytes. The frame need not declare its size.
std::string UnpackedZstd(std::string_view packed);
bool IsZstdFrame(std::string_view bytes);

}  // namespace tera
