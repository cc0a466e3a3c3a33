#include "diagnose/report/page/svg_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/statistics/series/simulated.h"

namespace tera {
namespace {

using ::testing::ElementsAre;

TEST(Envelope, KeepsTheLowestAndHighestOfEachBinInTheirOrder) {
  Series series = MakeSeries(0.5, {0, 5, -1, 2, /**/ 7, 7, 8, 1, /**/ 0, 0, 0, 0});
  for (std::size_t k = 8; k < 12; ++k) series.valid[k] = 0;
  const auto line = EnvelopeOf(series, {0, 12}, 2, 6);
  ASSERT_EQ(line.size(), 5u);
  EXPECT_EQ(line[0].x, 0.5);
  EXPECT_EQ(line[0].y, 10);
  EXPECT_EQ(line[1].x, 1);
  EXPECT_EQ(line[1].y, -2);
  EXPECT_EQ(line[2].x, 3);
  EXPECT_EQ(line[2].y, 16);
  EXPECT_EQ(line[3].x, 3.5);
  EXPECT_EQ(line[3].y, 2);
  EXPECT_TRUE(std::isnan(line[4].y));
}

TEST(Envelope, OfALongRecordingHasNoMorePointsThanAsked) {
  std::vector<double> value(60011);
  for (std::size_t k = 0; k < value.size(); ++k) value[k] = std::sin(0.37 * static_cast<double>(k));
  EXPECT_LE(EnvelopeOf(MakeSeries(0.01, value), {0, value.size()}, 1, 1500).size(), 1500u);
}

TEST(Ticks, AreRoundAndWithinTheAxis) {
  EXPECT_LT(TicksOf(Widened(1, std::nextafter(1, 2), ""), 5).size(), 20u);
  EXPECT_THAT(TicksOf({0, 10, ""}, 5), ElementsAre(0, 2, 4, 6, 8, 10));
  EXPECT_THAT(TicksOf({-0.3, 0.7, ""}, 4), ElementsAre(0, 0.5));
  EXPECT_THAT(TicksOf({41, 63, ""}, 5), ElementsAre(45, 50, 55, 60));
}

}  // namespace
}  // namespace tera
