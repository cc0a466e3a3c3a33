#include "dataset/import/bag/unpacked_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <system_error>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/import/bag/bag_file.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr const char* kOpenFiles = "/proc/self/fd";
constexpr std::uint64_t kPiece = std::uint64_t{1} << 20;
constexpr std::uint64_t kMostExpanded = 1000;  ///< ratio of sizes; about ten is usual for bags
constexpr std::uint64_t kLeftFree = std::uint64_t{64} << 20;

/// Limit of the decompressed size, from the ratio and the free disk space.
std::uint64_t MostBytes(const fs::path& packed, const fs::path& folder, std::uint64_t size) {
  std::error_code ignored;
  const std::uint64_t room = fs::space(folder, ignored).available;
  const std::uint64_t most = kMostExpanded * size + kPiece;
  if (ignored || room == static_cast<std::uint64_t>(-1)) return most;
  if (room < kLeftFree) {
    throw InputError(
        fmt::format("{}: is compressed as a whole, and {} has no space to unpack it; free some, or "
                    "set TMPDIR to another folder",
                    packed.string(), folder.string()));
  }
  return std::min(most, room - kLeftFree);
}

int NamelessFile(const fs::path& folder) {
  std::string name = (folder / "tera_bag_XXXXXX").string();
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) FailFile(name, "cannot be created", errno);
  ::unlink(name.c_str());
  return descriptor;
}

}  // namespace

UnpackedFile::UnpackedFile(const fs::path& packed)
    : packed_(packed), folder_(fs::temp_directory_path()), descriptor_(NamelessFile(folder_)) {
  path_ = fmt::format("{}/{}", kOpenFiles, descriptor_);
  try {
    Unpack();
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

UnpackedFile::~UnpackedFile() { ::close(descriptor_); }

bool IsUnpackedFile(const fs::path& path) { return path.parent_path() == kOpenFiles; }

std::string UnpackedFile::OfPacked(const std::string& message) const {
  std::string own = message;
  const std::size_t at = own.find(path_.string());
  return at == std::string::npos ? own : own.replace(at, path_.string().size(), packed_.string());
}

void UnpackedFile::Unpack() {
  BagFile packed(packed_);
  const std::uint64_t most = MostBytes(packed_, folder_, packed.size());
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                          &ZSTD_freeDStream);
  std::uint64_t written = 0;
  std::string out(kPiece, '\0');
  std::size_t left = 0;
  for (std::uint64_t at = 0; at < packed.size() && !damage_;) {
    const std::string piece = packed.Read(at, std::min(kPiece, packed.size() - at));
    at += piece.size();
    ZSTD_inBuffer in{piece.data(), piece.size(), 0};
    for (bool full = false; in.pos < in.size || (full && left != 0);) {
      ZSTD_outBuffer to{out.data(), out.size(), 0};
      left = ZSTD_decompressStream(stream.get(), &to, &in);
      if (ZSTD_isError(left)) {
        damage_ = fmt::format("cannot be unpacked by zstd: {}", ZSTD_getErrorName(left));
        break;
      }
      Write({out.data(), to.pos});
      written += to.pos;
      if (written > most) {
        throw InputError(fmt::format(
            "{}: its {} bytes unpack to more than {}, which is no plausible bag or exceeds the "
            "space in {}; unpack it with 'unzstd' on a larger disk, and name that file",
            packed_.string(), packed.size(), most, folder_.string()));
      }
      full = to.pos == to.size;
    }
  }
  if (!damage_ && left != 0) damage_ = "ends within its zstd frame";
}

void UnpackedFile::Write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) FailFile(folder_, "an unpacked bag cannot be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

const UnpackedFile& UnpackedFiles::Of(const fs::path& packed) {
  return files_.try_emplace(fs::absolute(packed).lexically_normal(), packed).first->second;
}

}  // namespace tera
