#include "core/config/spelling.h"

#include <gtest/gtest.h>

#include "core/parse_number.h"

namespace tera {
namespace {

TEST(LowerCase, ChangesCapitalLettersOfAsciiAlone) {
  EXPECT_EQ(LowerCase("Scan_07.PCD"), "scan_07.pcd");
  EXPECT_EQ(LowerCase("MÜLDE [Z@`{"), "mÜlde [z@`{");
}

TEST(ParseNumber, TakesAWholeTextOrNothing) {
  EXPECT_EQ(ParseNumber<double>("-2.5e-3"), -0.0025);
  EXPECT_EQ(ParseNumber<int>("42"), 42);
  for (const char* text : {"", " 1", "1 ", "1.5", "+1", "0x10", "99999999999"}) {
    EXPECT_EQ(ParseNumber<int>(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace tera
