#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace tera {

struct FileDigest {
  std::int64_t bytes = 0;
  std::string sha256;  ///< 64 hexadecimal digits
};

/// Source  FIPS 180-4, by OpenSSL. Throws InputError where the file cannot be read.
FileDigest DigestOf(const std::filesystem::path& file);
/// SHA-256 of these bytes, as FileDigest has it.
std::string Sha256Of(std::string_view bytes);

}  // namespace tera
