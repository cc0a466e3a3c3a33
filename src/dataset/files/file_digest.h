#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace tera {

struct FileDigest {
  std::int64_t bytes = 0;
  std::string sha256;  ///< 64 hexadecimal digits
};

/// Source  FIPS 180-4, by OpenSSL. Throws InputError where the file cannot be read.
FileDigest DigestOf(const std::filesystem::path& file);

}  // namespace tera
