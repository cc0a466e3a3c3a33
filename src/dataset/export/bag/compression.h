#pragma once

#include <string>
#include <string_view>

namespace tera {

enum class BagCompression { kZstd, kLz4, kNone };

/// "zstd", "lz4", or an empty text for no compression.
std::string_view NameOf(BagCompression compression);

/// Compresses `bytes` to one frame, with a checksum if readers of the format need it.
///
/// Source  RFC 8878 by libzstd; the LZ4 frame format 1.6 by liblz4.
std::string Compressed(BagCompression compression, std::string_view bytes);

}  // namespace tera
