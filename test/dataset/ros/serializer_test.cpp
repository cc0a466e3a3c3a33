#include "dataset/ros/serializer.h"

#include <gtest/gtest.h>

namespace tera::ros {
namespace {

std::string Hex(const std::string& bytes) {
  std::string text;
  for (const char c : bytes) {
    constexpr char kDigits[] = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(c);
    text += {kDigits[byte / 16], kDigits[byte % 16]};
  }
  return text;
}

std::string BytesOfSomeFields(WireForm form) {
  Serializer out(form);
  out.Put(std::uint8_t{1});
  out.Put(2.0);
  out.Put(std::string("ab"));
  out.Put(std::vector<std::uint16_t>{3});
  return Hex(out.bytes());
}

// Bytes by hand: 2.0 is 0x4000000000000000.
TEST(Serializer, CdrAlignsEachFieldAndEndsTexts) {
  EXPECT_EQ(BytesOfSomeFields(WireForm::kCdr),
            "00010000"
            "0100000000000000"
            "0000000000000040"
            "03000000616200"
            "00"  // the length begins at a multiple of four
            "010000000300");
}

TEST(Serializer, Ros1IsPacked) {
  EXPECT_EQ(BytesOfSomeFields(WireForm::kRos1),
            "01"
            "0000000000000040"
            "020000006162"
            "010000000300");
}

TEST(Serializer, AnEmptySequenceOfNumbersIsItsLengthAlone) {
  Serializer out(WireForm::kCdr);
  out.Put(std::vector<double>{});
  out.Put(std::uint8_t{7});
  EXPECT_EQ(Hex(out.bytes()), "000100000000000007");
}

TEST(Serializer, AfterClearTheNextMessageBeginsAnew) {
  Serializer out(WireForm::kCdr);
  out.Put(std::uint8_t{1});
  out.Clear();
  out.Put(std::uint32_t{2});
  EXPECT_EQ(Hex(out.bytes()), "0001000002000000");
}

TEST(Serializer, TimesBeforeZeroAreZero) {
  Serializer out(WireForm::kRos1);
  out.Put(Clock{-1});
  EXPECT_EQ(Hex(out.bytes()), "0000000000000000");
  out.Clear();
  out.Put(Clock{3 * kNsPerSecond + 258});
  EXPECT_EQ(Hex(out.bytes()), "0300000002010000");
}

TEST(Serializer, HeadersOfRos1HaveANumberBeforeTheStamp) {
  Serializer out(WireForm::kRos1);
  out.Put(CompressedImage{{kNsPerSecond, "a"}, "png", "xyz"});
  EXPECT_EQ(Hex(out.bytes()),
            "00000000"
            "0100000000000000"
            "0100000061"
            "03000000706e67"
            "0300000078797a");
}

}  // namespace
}  // namespace tera::ros
