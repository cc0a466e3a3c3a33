#include "dataset/files/block_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <fstream>
#include <random>

#include "core/faults.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using enum FaultKind;
namespace fs = std::filesystem;

constexpr char kMagic[] = "TERA blocks 1\n";

std::string RandomBytes(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random());
  return bytes;
}

std::string Number(std::uint32_t value) {
  std::string bytes;
  for (int b = 0; b < 4; ++b) bytes += static_cast<char>(value >> (8 * b));
  return bytes;
}

/// Limits the address space, relative to its present use: larger requests get bad_alloc.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::uint64_t more_bytes) {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &before_);
    const rlimit limit = {pages * static_cast<std::uint64_t>(getpagesize()) + more_bytes,
                          before_.rlim_max};
    setrlimit(RLIMIT_AS, &limit);
  }
  MemoryLimit(const MemoryLimit&) = delete;
  ~MemoryLimit() { setrlimit(RLIMIT_AS, &before_); }

 private:
  rlimit before_ = {};
};

struct Content {
  std::string header;
  std::vector<Block> blocks;
  bool operator==(const Content&) const = default;
};

class BlockFile : public testing::Test {
 protected:
  std::string Written(const Content& content) {
    BlockFileWriter writer(path(), content.header);
    for (const Block& block : content.blocks) writer.Append(block);
    writer.Commit();
    const std::string bytes = ReadWholeFile(path());
    EXPECT_EQ(writer.bytes(), static_cast<std::int64_t>(bytes.size()));
    return bytes;
  }
  Content ReadBack() {
    BlockFileReader reader(path());
    Content content{reader.header(), {}};
    while (std::optional<Block> block = reader.Next()) content.blocks.push_back(*block);
    EXPECT_FALSE(reader.Next());  // repeatedly
    return content;
  }
  /// Content of a file with these bytes; none if it is refused as expected.
  std::optional<Content> ReadFrom(const std::string& bytes) {
    std::ofstream(path(), std::ios::binary) << bytes;
    try {
      return ReadBack();
    } catch (const InputError& fault) {
      EXPECT_THAT(fault.faults(), HasFaultAt(path().string()));
      return std::nullopt;
    }
  }
  fs::path path() const { return scratch_.path() / "some.blocks"; }

  const ScratchDirectory scratch_;
};

const Content kSmall = {"a header\nof two lines", {{"one", "", "three"}, {std::string(500, 'x')}}};

TEST_F(BlockFile, GivesBackWhatWasWritten) {
  const Content contents[] = {
      {"", {}},
      {"header", {{""}}},
      {"", {{"", "", ""}, {std::string(1, '\0')}}},
      {std::string("\0\n\xff", 3), {{RandomBytes(1 << 20, 1), std::string(1 << 20, 'a'), ""}}},
      {RandomBytes(70000, 2), {{"a"}, {"b", "c"}, Block(300, "many"), {RandomBytes(777, 3)}}},
      kSmall};
  for (const Content& content : contents) {
    Written(content);
    EXPECT_TRUE(ReadBack() == content) << content.header.size() << " bytes of header";
  }
}

TEST_F(BlockFile, TheSameContentGivesTheSameBytes) { EXPECT_EQ(Written(kSmall), Written(kSmall)); }

TEST_F(BlockFile, AppearsUnderItsNameWhenItIsWhole) {
  {
    BlockFileWriter writer(path(), "header");
    writer.Append({"stream"});
    EXPECT_FALSE(fs::exists(path()));
  }
  EXPECT_TRUE(fs::is_empty(scratch_.path()));  // given up
}

TEST_F(BlockFile, ABlockOfNoStreamIsOurOwnMistake) {
  BlockFileWriter writer(path(), "header");
  EXPECT_THROW(writer.Append({}), InternalError);  // it would be read as the end
}

TEST_F(BlockFile, CompressesEachStreamByItself) {
  // A run of one byte: at most one block of 128 KiB in some ten bytes, far below a thousandth.
  // Random bytes: no compressor gains, and a frame's own bytes are few.
  const std::string same(1 << 20, 'z'), random = RandomBytes(1 << 20, 4);
  EXPECT_LT(Written({"", {{same}}}).size(), 1100u);
  const std::size_t both = Written({"", {{same, random}}}).size();
  EXPECT_GE(both, random.size());
  EXPECT_LT(both, random.size() + 2200u);
}

TEST_F(BlockFile, CutAnywhereItIsRefused) {
  const std::string whole = Written(kSmall);
  ASSERT_LT(whole.size(), 1000u);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(ReadFrom(whole.substr(0, size))) << "after " << size << " bytes";
  }
  EXPECT_TRUE(ReadFrom(whole) == kSmall);
}

TEST_F(BlockFile, CutWithinALargeStreamItIsRefused) {
  const std::string whole = Written({"header", {{RandomBytes(1 << 20, 5), "behind"}}});
  for (const double share : {0.01, 0.3, 0.7, 0.999}) {
    const auto size = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
    EXPECT_FALSE(ReadFrom(whole.substr(0, size))) << size;
  }
}

TEST_F(BlockFile, BytesBehindTheEndAreRefused) {
  const std::string whole = Written(kSmall);
  EXPECT_FALSE(ReadFrom(whole + "x"));
  EXPECT_FALSE(ReadFrom(whole + whole));
}

TEST_F(BlockFile, WithAByteThatIsAnotherNoBlockIsRead) {
  // The header has no checksum; callers compare it with the expected one. One bit of a frame has no
  // meaning, by RFC 8878 3.1.1.1.1.3. Hence either the file is refused, or the blocks are
  // unchanged.
  const std::string whole = Written(kSmall);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int mask : {0x10, 0xff}) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ mask);
      const auto content = ReadFrom(damaged);
      EXPECT_TRUE(!content || content->blocks == kSmall.blocks) << at << " ^ " << mask;
    }
  }
}

TEST_F(BlockFile, AnotherBeginningIsNamed) {
  const std::string whole = Written(kSmall);
  const std::string behind = whole.substr(sizeof(kMagic) - 1);
  EXPECT_TRUE(ReadFrom(kMagic + behind) == kSmall);
  for (const std::string begin :
       {"TERA blocks 2\n", "TERA blocks 1\r", "tera blocks 1\n", "", "PK\x03\x04", " "}) {
    EXPECT_FALSE(ReadFrom(begin + behind)) << begin;
  }
  EXPECT_FALSE(ReadFrom(RandomBytes(3000, 6)));
  EXPECT_FALSE(ReadFrom(std::string(3000, '\0')));
}

TEST_F(BlockFile, AFileThatIsNoneIsNamed) {
  const auto read = [](const fs::path& file) { BlockFileReader reader(file); };
  for (const fs::path& file : {scratch_.path() / "absent.blocks", scratch_.path()}) {
    EXPECT_THAT([&] { read(file); }, ThrowsFault(kUnreadable, file.string()));
  }
}

TEST_F(BlockFile, AFileThatCannotBeWrittenIsNamed) {
  const fs::path nowhere = scratch_.path() / "absent" / "some.blocks";
  EXPECT_THAT([&] { BlockFileWriter(nowhere, "header"); }, ThrowsFault(kUnwritable, "some.blocks"));
}

/// A frame of RFC 8878 with a content size in 8 bytes and one block of a run of `run` bytes.
std::string FrameThatClaims(std::uint64_t content_bytes, std::uint32_t run) {
  std::string frame = "\x28\xb5\x2f\xfd\xe0";
  for (int b = 0; b < 8; ++b) frame += static_cast<char>(content_bytes >> (8 * b));
  const std::uint32_t block = 1u | 1u << 1 | run << 3;  // the last one, a run
  for (int b = 0; b < 3; ++b) frame += static_cast<char>(block >> (8 * b));
  return frame + "z";
}

TEST_F(BlockFile, AbsurdLengthsAreRefusedWithoutTheMemoryForThem) {
  const MemoryLimit limit(256 << 20);
  const std::string begin = kMagic + Number(6) + "header";
  for (const std::uint32_t length : {0xffffffffu, 0x80000000u, 0x7fffffffu, 100'000'000u}) {
    EXPECT_FALSE(ReadFrom(kMagic + Number(length) + "header")) << length;
    EXPECT_FALSE(ReadFrom(begin + Number(length))) << length;
    EXPECT_FALSE(ReadFrom(begin + Number(length) + Number(3) + "abc")) << length;
    EXPECT_FALSE(ReadFrom(begin + Number(1) + Number(length) + "abc")) << length;
    EXPECT_FALSE(ReadFrom(begin + Number(length) + Number(length) + Number(length))) << length;
  }
}

TEST_F(BlockFile, AFrameThatClaimsMoreThanItHasIsRefusedWithoutTheMemoryForIt) {
  const MemoryLimit limit(256 << 20);
  const std::string begin = kMagic + Number(6) + "header" + Number(1);
  const auto with = [&](std::uint64_t claimed) {
    const std::string frame = FrameThatClaims(claimed, 1000);
    return begin + Number(static_cast<std::uint32_t>(frame.size())) + frame + Number(0);
  };
  for (const std::uint64_t claimed :
       {~0ull, ~0ull - 1, 1ull << 62, 1ull << 40, 1ull << 32, 1ull << 30, 2000ull, 0ull}) {
    EXPECT_FALSE(ReadFrom(with(claimed))) << claimed;
  }
}

TEST_F(BlockFile, RandomBytesBehindAGoodBeginningAreRefused) {
  const MemoryLimit limit(256 << 20);
  std::mt19937 random(7);
  for (int k = 0; k < 100; ++k) {
    // Small numbers lead deeper into the file than random ones.
    std::string bytes = kMagic + Number(random() % 4);
    for (int n = 0; n < 10; ++n)
      bytes += Number(1 + random() % 5) + RandomBytes(random() % 9, random());
    EXPECT_FALSE(ReadFrom(bytes)) << k;
  }
}

}  // namespace
}  // namespace tera
