#include "dataset/export/webdataset/tar_names.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string_view>
#include <system_error>

namespace tera {
namespace {

constexpr std::uintmax_t kTarBlockBytes = 512;
constexpr std::size_t kNameBytes = 100, kSizeAt = 124, kSizeDigits = 11, kMagicAt = 257;

std::string_view Trimmed(std::string_view field) { return field.substr(0, field.find('\0')); }

/// Number of blocks that a file occupies; nullopt if the header holds no valid size.
std::optional<std::uintmax_t> BlocksOf(std::string_view header) {
  std::uintmax_t bytes = 0;
  const char* const first = header.data() + kSizeAt;
  const auto [end, error] = std::from_chars(first, first + kSizeDigits, bytes, 8);
  if (error != std::errc() || end != first + kSizeDigits) return std::nullopt;
  return (bytes + kTarBlockBytes - 1) / kTarBlockBytes;
}

}  // namespace

std::optional<std::vector<std::string>> NamesInTar(const std::filesystem::path& archive) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(archive, error);
  std::ifstream file(archive, std::ios::binary);
  if (error || !file || size % kTarBlockBytes != 0) return std::nullopt;
  std::vector<std::string> names;
  std::string header(kTarBlockBytes, '\0');
  const std::uintmax_t blocks = size / kTarBlockBytes;
  for (std::uintmax_t block = 0; block + 2 <= blocks;) {
    file.seekg(static_cast<std::streamoff>(block * kTarBlockBytes));
    if (!file.read(header.data(), static_cast<std::streamsize>(kTarBlockBytes)))
      return std::nullopt;
    const bool is_end = std::all_of(header.begin(), header.end(), [](char c) { return c == 0; });
    if (is_end && block + 2 == blocks) return names;
    const auto of_file = BlocksOf(header);
    if (is_end || header.compare(kMagicAt, 5, "ustar") != 0 || !of_file) return std::nullopt;
    if (*of_file > blocks - block - 1) return std::nullopt;
    names.emplace_back(Trimmed(std::string_view(header).substr(0, kNameBytes)));
    block += 1 + *of_file;
  }
  return std::nullopt;
}

}  // namespace tera
