#pragma once

#include <string>
#include <string_view>

namespace tera {

enum class BagCompression { kZstd, kLz4, kNone };

/// "zstd", "lz4", or empty.
std::string_view NameOf(BagCompression compression);

/// `bytes` as one compressed frame, with a checksum if its readers need one.
///
/// Source  RFC 8878 by libzstd; the LZ4 frame format 1.6 by liblz4.
std::string Compressed(BagCompression compression, std::string_view bytes);

}  // namespace tera
