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

/// Size and SHA-256 of a file. Throws InputError if the file cannot be read.
///
/// Source  FIPS 180-4, by OpenSSL.
FileDigest DigestOf(const std::filesystem::path& file);
/// SHA-256 of the bytes as 64 hexadecimal digits.
std::string Sha256Of(std::string_view bytes);

}  // namespace tera
