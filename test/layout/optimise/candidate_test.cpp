#include "layout/optimise/candidate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "layout/optimise/walled_site.h"

namespace tera {
namespace {

TEST(Genes, NoneIsFixedHoweverLittleThereIsToChoose) {
  WalledSite site;
  for (const LayoutSearch& search : {LoadSearch(site.OneLidar()), LoadSearch(site.TwoLidars())}) {
    const GeneBounds bounds = BoundsOf(search);
    ASSERT_EQ(bounds.low.size(), bounds.high.size());
    EXPECT_EQ(bounds.whole, 2 * search.slots.size());
    for (std::size_t g = 0; g < bounds.low.size(); ++g) EXPECT_LT(bounds.low[g], bounds.high[g]);
  }
}

TEST(Genes, AtTheirBoundsStandForTheBoundsOfAMount) {
  WalledSite site;
  const LayoutSearch search = LoadSearch(site.OneLidar());
  const GeneBounds bounds = BoundsOf(search);
  for (const auto& [genes, y_m] : {std::pair(bounds.low, -4.0), std::pair(bounds.high, 4.0)}) {
    const std::vector<SensorDescription> sensors = SensorsOf(search, genes);
    ASSERT_EQ(sensors.size(), 1u);
    EXPECT_EQ(sensors[0].name, "lidar");
    EXPECT_EQ(sensors[0].link, "mast");
    EXPECT_TRUE(sensors[0].X_BS.translation().isApprox(Vec3(0, y_m, kLidarHeight_m)));
  }
}

TEST(Genes, OfATypeNoughtLeaveAnOptionalSensorOut) {
  WalledSite site;
  const LayoutSearch search = LoadSearch(site.TwoLidars());
  const std::vector<SensorDescription> sensors = SensorsOf(search, BoundsOf(search).low);
  ASSERT_EQ(sensors.size(), 1u);
  EXPECT_EQ(sensors[0].name, "first");
  EXPECT_EQ(sensors[0].cost, 100);
  // The first mount at its lowest: 5 degrees to one side, and turned about.
  EXPECT_NEAR(sensors[0].X_BS.linear()(2, 2), std::cos(5 * kDeg), 1e-9);
}

}  // namespace
}  // namespace tera
