#include "dataset/files/file_digest.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>

#include "core/check.h"
#include "core/error.h"

namespace tera {

FileDigest DigestOf(const std::filesystem::path& file) {
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> hash(EVP_MD_CTX_new(),
                                                                     EVP_MD_CTX_free);
  TERA_CHECK(hash && EVP_DigestInit_ex(hash.get(), EVP_sha256(), nullptr) == 1, file.string());
  FileDigest digest;
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 1 << 16> block;
  while (stream) {
    stream.read(block.data(), block.size());
    const auto count = static_cast<std::size_t>(stream.gcount());
    TERA_CHECK(EVP_DigestUpdate(hash.get(), block.data(), count) == 1, file.string());
    digest.bytes += stream.gcount();
  }
  if (!stream.eof() || stream.bad()) {
    throw InputError(fmt::format("{}: cannot be read; need a readable file", file.string()));
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> sum;
  unsigned int size = 0;
  TERA_CHECK(EVP_DigestFinal_ex(hash.get(), sum.data(), &size) == 1, file.string());
  for (unsigned int i = 0; i < size; ++i) digest.sha256 += fmt::format("{:02x}", sum[i]);
  return digest;
}

}  // namespace tera
