#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tera {

/// Chunks and messages as they were before compression; the memory grows with what is there, not
/// with what is declared. BadBytes where they cannot be unpacked or are not of the `size` that is
/// declared.
std::string UnpackedZstd(std::string_view packed, std::uint64_t size);
std::string UnpackedLz4(std::string_view packed, std::uint64_t size);
std::string UnpackedBzip2(std::string_view packed, std::uint64_t size);

/// A frame of zstd that declares its own size or none, up to kMostPieceBytes.
std::string UnpackedZstd(std::string_view packed);
bool IsZstdFrame(std::string_view bytes);

}  // namespace tera
