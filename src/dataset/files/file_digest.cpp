#include "dataset/files/file_digest.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>

#include "core/check.h"
#include "core/config/fault_text.h"

namespace tera {
namespace {

/// Incremental SHA-256.
class Sha256 {
 public:
  Sha256() { TERA_CHECK(hash_ && EVP_DigestInit_ex(hash_.get(), EVP_sha256(), nullptr) == 1); }
  void Add(const char* bytes, std::size_t count) {
    TERA_CHECK(EVP_DigestUpdate(hash_.get(), bytes, count) == 1, count);
  }
  /// Returns the digest as hexadecimal digits. No other call may follow.
  std::string Finish() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> sum;
    unsigned int size = 0;
    TERA_CHECK(EVP_DigestFinal_ex(hash_.get(), sum.data(), &size) == 1);
    std::string digits;
    for (unsigned int i = 0; i < size; ++i) digits += fmt::format("{:02x}", sum[i]);
    return digits;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> hash_{EVP_MD_CTX_new(), EVP_MD_CTX_free};
};

}  // namespace

FileDigest DigestOf(const std::filesystem::path& file) {
  Sha256 hash;
  FileDigest digest;
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 1 << 16> block;
  while (stream) {
    stream.read(block.data(), block.size());
    hash.Add(block.data(), static_cast<std::size_t>(stream.gcount()));
    digest.bytes += stream.gcount();
  }
  if (!stream.eof() || stream.bad()) {
    throw InputError(file.string(), fault::CannotBeRead("a readable file"));
  }
  digest.sha256 = hash.Finish();
  return digest;
}

std::string Sha256Of(std::string_view bytes) {
  Sha256 hash;
  hash.Add(bytes.data(), bytes.size());
  return hash.Finish();
}

}  // namespace tera
