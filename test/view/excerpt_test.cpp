#include "view/excerpt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/faults.h"
#include "view/small_recording.h"

namespace tera {
namespace {

using enum FaultKind;
using nlohmann::json;

constexpr char kPage[] = "<body><!--pack--><script>draw</script></body>";
constexpr std::uint64_t kPlenty = 10'000'000;

std::string Between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin) + begin.size();
  return text.substr(from, text.find(end, from) - from);
}

/// By the rules of RFC 4648, digit by digit.
std::string FromBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned word = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = word << 6 | static_cast<unsigned>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(word >> bits & 255);
  }
  return bytes;
}

/// Content that the page reads under a name.
std::string Packed(const std::string& html, const std::string& name) {
  const json head = json::parse(Between(html, "id=\"pack-head\">", "</script>"));
  const auto& place = head["places"][name];
  return FromBase64(Between(html, "id=\"pack-bytes\">", "</script>")).substr(place[0], place[1]);
}

TEST(Excerpt, HoldsTablesFramesAndTheScene) {
  Viewed viewed = OpenViewed(SmallRecording("packed"));
  viewed.stage = [] { return std::string("the scene"); };
  const Excerpt excerpt = MakeExcerpt({viewed}, kPage, kPlenty);
  EXPECT_EQ(Packed(excerpt.html, "0/digger/commands.csv"), "t_ns,boom\n0,0.5\n1000000000,-1\n");
  EXPECT_EQ(Packed(excerpt.html, "0/digger/camera/rgb/1000000000.png"), "second picture");
  EXPECT_EQ(Packed(excerpt.html, "0/digger/lidar/scans/0.pcd"), "first scan");
  EXPECT_EQ(Packed(excerpt.html, "0/stage"), "the scene");
  EXPECT_THAT(excerpt.html, testing::HasSubstr("<script>draw</script>"));
  EXPECT_EQ(excerpt.words,
            "An excerpt: 4 of 4 frames (every one), at most 2000 rows of each table");
}

TEST(Excerpt, IsNoLargerThanAskedFor) {
  const std::filesystem::path recording = SmallRecording("large");
  const std::string noise(3'000'000, 'x');
  WriteFileAt(recording / "digger/lidar/scans/0.pcd", noise);
  WriteFileAt(recording / "digger/lidar/scans/1000000000.pcd", noise);
  const Viewed viewed = OpenViewed(recording);
  const Excerpt excerpt = MakeExcerpt({viewed}, kPage, 5'000'000);
  EXPECT_LE(excerpt.html.size(), 5'000'000u);
  EXPECT_EQ(excerpt.words,
            "An excerpt: 2 of 4 frames (every second), at most 2000 rows of each table");
  EXPECT_THAT([&] { MakeExcerpt({viewed}, kPage, 1'000'000); }, ThrowsFault(kOutOfRange, "--size"));
}

TEST(Excerpt, TakesNoFileFromOutsideTheFolder) {
  const std::filesystem::path recording = SmallRecording("leading_out");
  const std::filesystem::path secret = recording.parent_path() / "secret.csv";
  WriteFileAt(secret, "t_ns,key\n0,12345\n");
  const std::filesystem::path table = recording / "digger/commands.csv";
  std::filesystem::remove(table);
  std::filesystem::create_symlink(secret, table);
  EXPECT_THROW(MakeExcerpt({OpenViewed(recording)}, kPage, kPlenty), InputError);
}

TEST(Excerpt, LetsNoTextOfTheDataEndItsScript) {
  const std::filesystem::path why = OwnFolder() / "sly";
  WriteFileAt(why / "diagnosis.json",
              R"({"verdict": ["</script><script>alert(1)</script>"], "findings": []})");
  const Excerpt excerpt = MakeExcerpt({OpenViewed(why)}, kPage, kPlenty);
  EXPECT_THAT(excerpt.html, testing::Not(testing::HasSubstr("<script>alert")));
}

}  // namespace
}  // namespace tera
