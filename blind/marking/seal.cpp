#include "blind/marking/seal.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <fstream>

#include "core/check.h"
#include "core/error.h"

namespace tera::blind {
namespace {

void Append(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::app | std::ios::binary);
  stream << text;
  stream.close();
  if (!stream)
    throw InputError(fmt::format("{}: cannot be written; check the disk", file.string()));
}

}  // namespace

std::string Digest(const std::string& text) {
  unsigned char bytes[EVP_MAX_MD_SIZE];
  unsigned int count = 0;
  TERA_CHECK(EVP_Digest(text.data(), text.size(), bytes, &count, EVP_sha256(), nullptr) == 1,
             "no SHA-256");
  std::string hex;
  for (unsigned int i = 0; i < count; ++i) hex += fmt::format("{:02x}", bytes[i]);
  return hex;
}

void SealTruth(const std::string& truth, const std::filesystem::path& folder) {
  Append(folder / "seal.txt", fmt::format("truth {}\n", Digest(truth)));
}

void OpenTruth(const std::string& truth, const std::string& answer,
               const std::filesystem::path& folder) {
  Append(folder / "seal.txt",
         fmt::format("answer {}\nboth {}\n", Digest(answer), Digest(truth + answer)));
  Append(folder / "truth.json", truth);
}

}  // namespace tera::blind
