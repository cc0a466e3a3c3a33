#include "core/config/plain_name.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

TEST(PlainName, HasLettersDigitsUnderscoresAndHyphens) {
  for (const char* name : {"a", "excavator1", "Left_track-2", "-", "0"}) {
    EXPECT_TRUE(IsPlainName(name)) << name;
    EXPECT_TRUE(IsPlainNameWithPoints(name)) << name;
  }
  EXPECT_TRUE(IsPlainName(std::string(kLongestName, 'x')));
}

TEST(PlainName, CannotLeaveItsFolderOrBreakAHeader) {
  const std::string long_name(kLongestName + 1, 'x');
  for (const std::string name : {"", ".", "..", "../a", "/a", "a/b", "a\\b", "a b", "a,b", "a\nb",
                                 "a\"b", "caf\xc3\xa9", ".hidden", long_name.c_str()}) {
    EXPECT_FALSE(IsPlainName(name)) << name;
    EXPECT_FALSE(IsPlainNameWithPoints(name)) << name;
  }
  EXPECT_FALSE(IsPlainName("wheel.left"));
  EXPECT_TRUE(IsPlainNameWithPoints("wheel.left"));
}

}  // namespace
}  // namespace tera
