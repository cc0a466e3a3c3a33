#include "dataset/export/picture/run_lengths.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

// Texts by hand from COCO's description: five bits a character from '0' (48) on, plus 32 if more
// follow, sign in bit 16. From the fourth run on, minus the run two before.
TEST(RunLengths, ShortRunsAreOneCharacterEach) {
  RunLengths runs;
  runs.Add(2, 3);
  EXPECT_EQ(runs.area_px(), 3);
  EXPECT_EQ(runs.Compressed(9), "234");  // 2 outside, 3 inside, 4 outside
}

TEST(RunLengths, RunsOfSixteenAndMoreTakeMoreCharacters) {
  RunLengths runs;
  runs.Add(0, 16);
  // 0: '0'. 16 = 10000b, whose bit 16 would be a sign: 16 + 32 = 48, '`'; then 0. 84 = 2 * 32 + 20:
  // 20 + 32 = 52, 'd'; then 2.
  EXPECT_EQ(runs.Compressed(100), "0`0d2");
}

TEST(RunLengths, LaterRunsAreDifferencesThatMayBeNegative) {
  RunLengths runs;
  runs.Add(1, 9);
  runs.Add(12, 4);
  // 1, 9, 2, then 4 - 9 = -5 = 11011b, whose bit 16 is the sign: 27 + 48 = 'K'; 4 - 2 = 2.
  EXPECT_EQ(runs.Compressed(20), "192K2");
}

TEST(RunLengths, TouchingRunsAreOne) {
  RunLengths runs;
  runs.Add(1, 2);
  runs.Add(3, 4);
  EXPECT_EQ(runs.Compressed(7), "16");
  EXPECT_EQ(runs.area_px(), 6);
}

TEST(RunLengths, AMaskWithoutPixelsIsOneRun) { EXPECT_EQ(RunLengths().Compressed(7), "7"); }

}  // namespace
}  // namespace tera
