#include "dataset/export/webdataset/tar_writer.h"

#include <fmt/format.h>

#include <string>

#include "core/check.h"
#include "core/error.h"

namespace tera {
namespace {

constexpr std::size_t kBlockBytes = 512;
constexpr std::size_t kMostNameBytes = 100, kMostPrefixBytes = 155;

void Append(std::string_view text, std::size_t size, std::string* header) {
  TERA_CHECK(text.size() <= size, text, size);
  header->append(text);
  header->append(size - text.size(), '\0');
}

std::string Header(std::string_view folder, std::string_view name, std::size_t bytes) {
  constexpr std::size_t kChecksumAt = 148;
  std::string header;
  Append(name, kMostNameBytes, &header);
  for (const char* mode_and_owners : {"0000644", "0000000", "0000000"}) {
    Append(mode_and_owners, 8, &header);
  }
  Append(fmt::format("{:011o}", bytes), 12, &header);
  Append(fmt::format("{:011o}", 0), 12, &header);  // time
  header.append(8, ' ');     // the checksum is computed with blanks in its own field
  header += '0';             // regular file
  Append("", 100, &header);  // link name
  Append("ustar", 6, &header);
  header += "00";
  Append("", 32 + 32 + 8 + 8, &header);  // names of owners, devices
  Append(folder, kMostPrefixBytes, &header);
  Append("", kBlockBytes - header.size(), &header);
  unsigned sum = 0;
  for (const char c : header) sum += static_cast<unsigned char>(c);
  return header.replace(kChecksumAt, 8, fmt::format("{:06o}", sum) + std::string("\0 ", 2));
}

}  // namespace

void TarWriter::Add(std::string_view folder, std::string_view name, std::string_view bytes) {
  if (folder.size() > kMostPrefixBytes || name.size() > kMostNameBytes) {
    throw InputError(
        "",
        {FaultKind::kOutOfRange,
         fmt::format("'{}/{}': is too long a name for a tar archive; need at most {} and {} bytes",
                     folder, name, kMostPrefixBytes, kMostNameBytes)});
  }
  file_.Append(Header(folder, name, bytes.size()));
  file_.Append(bytes);
  const std::size_t over = bytes.size() % kBlockBytes;
  if (over != 0) file_.Append(std::string(kBlockBytes - over, '\0'));
}

std::int64_t TarWriter::SpaceOf(std::size_t bytes) {
  return static_cast<std::int64_t>((1 + (bytes + kBlockBytes - 1) / kBlockBytes) * kBlockBytes);
}

std::int64_t TarWriter::bytes() const {
  return file_.bytes() + static_cast<std::int64_t>(2 * kBlockBytes);
}

void TarWriter::Commit() {
  file_.Append(std::string(2 * kBlockBytes, '\0'));
  file_.Commit();
}

}  // namespace tera
