#include <gtest/gtest.h>

#include "diagnose/replay/axis_log.h"

namespace tera {
namespace {

TEST(BetweenSamples, AreStraightInBetweenAndAsTheNearestBeyond) {
  const std::vector<TimeNs> t_ns = {100, 200, 600};
  const std::vector<double> values = {-3, 5, 1};
  const auto at = [&](TimeNs at_ns) { return BetweenSamples(t_ns, at_ns).Of(values); };
  EXPECT_EQ(at(99), -3);
  EXPECT_EQ(at(100), -3);
  EXPECT_EQ(at(125), -1);
  EXPECT_EQ(at(200), 5);
  EXPECT_EQ(at(300), 4);
  EXPECT_EQ(at(600), 1);
  EXPECT_EQ(at(601), 1);
}

TEST(BetweenSamples, OfOneSampleAreThatSample) {
  for (const TimeNs at_ns : {-5, 7, 9}) EXPECT_EQ(BetweenSamples({7}, at_ns).Of({2.5}), 2.5);
}

}  // namespace
}  // namespace tera
