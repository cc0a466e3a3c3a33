#include "dataset/import/bag/unpacked_file.h"

#include <gtest/gtest.h>

#include <random>

#include "dataset/export/bag/compression.h"
#include "dataset/files/checked_file.h"
#include "own_folder.h"

namespace tera {
namespace {

/// Bytes that zstd cannot shorten below a thousandth.
std::string Bytes(std::size_t size) {
  std::mt19937 random(3);
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random() % 17);
  return bytes;
}

// The frame's last bytes may fill the buffer that they are unpacked into to its brim.
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

}  // namespace
}  // namespace tera
