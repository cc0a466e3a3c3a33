#include "dataset/import/bag/unpacked_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iterator>
#include <random>

#include "core/error.h"
#include "dataset/export/bag/compression.h"
#include "dataset/files/checked_file.h"
#include "own_folder.h"

namespace tera {
namespace {

/// Bytes that zstd cannot compress below a thousandth.
std::string Bytes(std::size_t size) {
  std::mt19937 random(3);
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random() % 17);
  return bytes;
}

// The frame's last bytes may fill the output buffer completely.
TEST(UnpackedFile, OfAnySizeIsWhole) {
  for (const std::size_t size : {std::size_t{1000}, std::size_t{1} << 20, std::size_t{3} << 20,
                                 (std::size_t{3} << 20) + 1}) {
    const std::string bytes = Bytes(size);
    const std::filesystem::path packed = OwnFolder() / "log.db3.zstd";
    WriteWholeFile(packed, Compressed(BagCompression::kZstd, bytes));
    const UnpackedFile file(packed);
    EXPECT_FALSE(file.damage()) << size << ": " << file.damage().value_or("");
    EXPECT_TRUE(ReadWholeFile(file.path()) == bytes) << size;
  }
}

std::filesystem::path Packed(const std::string& name, const std::string& bytes) {
  const std::filesystem::path packed = OwnFolder() / name;
  WriteWholeFile(packed, Compressed(BagCompression::kZstd, bytes));
  return packed;
}

/// Folder of temporary files during this object's life.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::filesystem::create_directories(path_);
    setenv("TMPDIR", path_.c_str(), 1);
  }
  ~TemporaryFolder() { unsetenv("TMPDIR"); }
  bool IsEmpty() const { return std::filesystem::is_empty(path_); }

 private:
  std::filesystem::path path_ = OwnFolder() / "temporary";
};

// After any end of the program, Ctrl-C or a kill, no file remains.
TEST(UnpackedFile, HasNoNameThatCouldBeLeftBehind) {
  const std::string bytes = Bytes(100'000);
  const std::filesystem::path packed = Packed("log.db3.zstd", bytes);
  const TemporaryFolder temporary;
  const UnpackedFile file(packed);
  EXPECT_TRUE(temporary.IsEmpty());
  EXPECT_TRUE(ReadWholeFile(file.path()) == bytes);
}

TEST(UnpackedFile, IsClosedAtItsEndAndAfterAFault) {
  const std::filesystem::path packed = Packed("log.db3.zstd", Bytes(1000));
  const std::filesystem::path bomb = Packed("bomb.db3.zstd", std::string(100'000'000, '\0'));
  const auto open_files = [] {
    const std::filesystem::directory_iterator files("/proc/self/fd");
    return std::distance(begin(files), end(files));
  };
  const auto before = open_files();
  EXPECT_EQ(UnpackedFile(packed).damage(), std::nullopt);
  EXPECT_THROW(UnpackedFile{bomb}, InputError);
  EXPECT_EQ(open_files(), before);
}

TEST(UnpackedFiles, UnpackEachOnce) {
  const std::filesystem::path one = Packed("one.db3.zstd", "one"), two = Packed("two.zst", "two");
  UnpackedFiles files;
  const UnpackedFile& first = files.Of(one);
  EXPECT_EQ(ReadWholeFile(files.Of(two).path()), "two");
  // Another path to the same file; another file would give another object.
  EXPECT_EQ(&files.Of(OwnFolder() / "." / "one.db3.zstd"), &first);
  std::filesystem::remove(one);
  EXPECT_EQ(ReadWholeFile(files.Of(one).path()), "one");
}

}  // namespace
}  // namespace tera
