#include "dataset/export/counted_file.h"

#include <cerrno>
#include <fstream>
#include <string>

namespace tera {
namespace fs = std::filesystem;
namespace {

fs::path RestOf(const fs::path& path) {
  fs::path rest = path;
  rest += ".rest";
  return rest;
}

}  // namespace

CountedFile::CountedFile(const fs::path& path) : path_(path), rest_(RestOf(path)) {}

void CountedFile::Commit(std::string_view header) {
  constexpr std::size_t kPiece = 1024 * 1024;
  rest_.Commit();
  CheckedFile file(path_);
  file.Append(header);
  std::ifstream rest(rest_.path(), std::ios::binary);
  if (!rest) FailFile(rest_.path(), "cannot be read a second time", errno);
  std::string piece(kPiece, '\0');
  while (rest.read(piece.data(), static_cast<std::streamsize>(kPiece)) || rest.gcount() > 0) {
    file.Append({piece.data(), static_cast<std::size_t>(rest.gcount())});
  }
  if (rest.bad()) FailFile(rest_.path(), "cannot be read a second time", errno);
  file.Commit();
  fs::remove(rest_.path());
}

}  // namespace tera
