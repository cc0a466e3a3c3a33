#include "view/served_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "core/error.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace {

/// True if each part between slashes is a plain name.
bool IsPlain(std::string_view relative) {
  if (relative.empty() || relative.find('\0') != std::string_view::npos) return false;
  std::size_t begin = 0;
  while (begin <= relative.size()) {
    const std::size_t end = std::min(relative.find('/', begin), relative.size());
    const std::string_view part = relative.substr(begin, end - begin);
    if (part.empty() || part == "." || part == "..") return false;
    begin = end + 1;
  }
  return true;
}

bool IsBelow(const std::filesystem::path& root, const std::filesystem::path& file) {
  const auto [end_of_root, _] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  return end_of_root == root.end() && file != root;
}

}  // namespace

ServedFolder::ServedFolder(const std::filesystem::path& folder) {
  std::error_code error;
  root_ = std::filesystem::canonical(folder, error);
  if (error || !std::filesystem::is_directory(root_, error)) {
    throw InputError(folder.string(), {FaultKind::kUnreadable,
                                       "is no folder; need that of a dataset or of a diagnosis"});
  }
}

std::optional<std::filesystem::path> ServedFolder::Find(std::string_view relative) const {
  if (!IsPlain(relative)) return std::nullopt;
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(root_ / relative, error);
  if (error || !IsBelow(root_, file)) return std::nullopt;
  if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
  return file;
}

std::string ServedFolder::Read(std::string_view relative) const {
  const auto file = Find(relative);
  if (!file) {
    throw InputError(root_.string(), {FaultKind::kNoSuchName,
                                      fmt::format("'{}' is no file below it; need one that is "
                                                  "there, without '..' and links that lead out",
                                                  relative)});
  }
  return ReadWholeFile(*file);
}

std::string ReadPart(const std::filesystem::path& file, std::uint64_t begin, std::size_t length) {
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(begin));
  std::string bytes(length, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(length));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return bytes;
}

}  // namespace tera
