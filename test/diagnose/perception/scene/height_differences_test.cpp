#include "diagnose/perception/scene/height_differences.h"

#include <gtest/gtest.h>

#include "diagnose/perception/analytic_scene.h"

namespace tera {
namespace {

using testing::AnalyticScene;
using testing::LidarOfTest;
using testing::RecordedBy;

std::vector<HeightDifference> DifferencesOf(const AnalyticScene& real,
                                            const AnalyticScene& simulated) {
  LidarOfTest lidar;
  lidar.noise_m = 0;
  const RangeSource source = RecordedBy(lidar, real, simulated);
  const PointFlags none = NoPoints(source.scans);
  std::vector<HeightDifference> differences;
  for (std::size_t s = 0; s < source.scans.size(); s += 10) {
    AddHeightDifferences(source, source.calibration(), 1, s, none[s], 0.25, &differences);
  }
  return differences;
}

TEST(HeightDifferences, AreThoseOfGroundThatLiesHigherEverywhere) {
  AnalyticScene raised;
  raised.relief = [](const Vec2&) { return 0.3; };
  raised.has_box = false;
  AnalyticScene simulated;
  simulated.has_box = false;
  const auto differences = DifferencesOf(raised, simulated);
  ASSERT_GT(differences.size(), 1000u);
  for (const HeightDifference& one : differences) EXPECT_NEAR(one.above_m, 0.3, 1e-4);
}

TEST(HeightDifferences, AreNotTakenOnSimulatedObjects) {
  const auto differences = DifferencesOf({}, {});
  ASSERT_GT(differences.size(), 1000u);
  // The box is 2.4 m high.
  for (const HeightDifference& one : differences) EXPECT_NEAR(one.above_m, 0, 1e-4);
}

TEST(HeightDifferences, OfAPointBelongToTheCellThatItLiesIn) {
  EXPECT_EQ(CellAt({0.3, 0.7}, 0.25), (CellIndex{1, 2}));
  EXPECT_EQ(CellAt({-0.1, -0.26}, 0.25), (CellIndex{-1, -2}));
}

}  // namespace
}  // namespace tera
