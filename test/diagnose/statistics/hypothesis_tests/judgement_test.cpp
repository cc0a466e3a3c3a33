#include <gtest/gtest.h>

#include "diagnose/statistics/hypothesis_tests/block_bootstrap.h"
#include "diagnose/statistics/hypothesis_tests/multiple_testing.h"

namespace tera {
namespace {

TEST(Holm, AdjustsAsInTheWorkedExample) {
  const std::vector<double> adjusted = HolmAdjusted({0.01, 0.04, 0.03, 0.005});
  const std::vector<double> expected = {0.03, 0.06, 0.06, 0.02};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(adjusted[k], expected[k], 1e-12);
  EXPECT_EQ(HolmAdjusted({0.9, 0.8})[0], 1);
}

TEST(Bootstrap, BlocksCoverEverythingOnce) {
  const std::vector<Segment> blocks = CutIntoBlocks(103, 20);
  EXPECT_EQ(blocks.size(), 5u);
  EXPECT_EQ(blocks.back(), (Segment{80, 103}));
  EXPECT_EQ(CutIntoBlocks(115, 20).size(), 6u);
  EXPECT_EQ(CutIntoBlocks(3, 20).front(), (Segment{0, 3}));
}

}  // namespace
}  // namespace tera
