#include "diagnose/perception/scene/ground_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/perception/analytic_scene.h"
#include "diagnose/perception/scene/scan_diagnosis.h"

namespace tera {
namespace {

using testing::AnalyticScene;
using testing::IdOf;
using testing::LidarOfTest;
using testing::NumberOf;
using testing::RecordedBy;
using testing::TargetOf;

/// A round heap with a flat top: 0.4 m high, 1.2 m in radius there, 1.8 m at its foot.
double Heap_m(const Vec2& xy_m) {
  const double r_m = (xy_m - Vec2(4, -3)).norm();
  return 0.4 * std::clamp((1.8 - r_m) / 0.6, 0.0, 1.0);
}
/// Its volume: a frustum, pi h / 3 (R^2 + R r + r^2).
constexpr double kHeap_m3 = kPi * 0.4 / 3 * (1.8 * 1.8 + 1.8 * 1.2 + 1.2 * 1.2);

GroundMap MapOf(const AnalyticScene& real, const AnalyticScene& simulated,
                const LidarOfTest& lidar = {}) {
  const RangeSource source = RecordedBy(lidar, real, simulated);
  std::vector<TimeNs> t_ns;
  for (const RangeScan& scan : source.scans) t_ns.push_back(scan.t_ns);
  return CompareGround(source, SplitScans(t_ns, Stream(1, "test/split")),
                       lidar.is.Calibration(source.X_BS), 1, NoPoints(source.scans));
}

TEST(GroundMap, AHeapThatWasNotSimulatedIsOneRegionOfItsVolume) {
  AnalyticScene heaped;
  heaped.relief = Heap_m;
  const GroundMap map = MapOf(heaped, {});
  ASSERT_EQ(map.regions.size(), 1u);
  const GroundRegion& region = map.regions[0];
  EXPECT_NEAR(region.centre_W_m.x(), 4, 0.25);
  EXPECT_NEAR(region.centre_W_m.y(), -3, 0.25);
  // The top occludes the far flank at times.
  EXPECT_NEAR(region.volume_m3, kHeap_m3, 0.15 * kHeap_m3);
  EXPECT_NEAR(region.area_m2, kPi * 1.7 * 1.7, 2);
  EXPECT_NEAR(region.highest_m, 0.4, 0.03);
  EXPECT_FALSE(region.upright);
  EXPECT_LT(region.p_confirmed, 0.001);
  EXPECT_TRUE(region.intervals_s.empty());
  EXPECT_LT(region.rmse_after_m, 0.3 * region.rmse_before_m);
}

TEST(GroundMap, AHeapThatIsGoneIsSoilMissing) {
  AnalyticScene heaped;
  heaped.relief = Heap_m;
  const GroundMap map = MapOf({}, heaped);
  ASSERT_EQ(map.regions.size(), 1u);
  EXPECT_NEAR(map.regions[0].volume_m3, -kHeap_m3, 0.15 * kHeap_m3);
}

TEST(GroundMap, TheSameGroundHasNoRegion) {
  AnalyticScene heaped;
  heaped.relief = Heap_m;
  for (const std::uint64_t seed : {1u, 2u}) {
    LidarOfTest lidar;
    lidar.seed = seed;
    const GroundMap map = MapOf(heaped, heaped, lidar);
    EXPECT_TRUE(map.regions.empty());
    EXPECT_TRUE(map.unconfirmed.empty());
    EXPECT_GT(map.cells.size(), 500u);
  }
}

TEST(GroundMap, AnObjectWithWallsIsUpright) {
  AnalyticScene without;
  without.has_box = false;
  const GroundMap map = MapOf({}, without);
  ASSERT_EQ(map.regions.size(), 1u);
  EXPECT_TRUE(map.regions[0].upright);
  EXPECT_NEAR(map.regions[0].centre_W_m.x(), 6, 1.0);
  EXPECT_NEAR(map.regions[0].centre_W_m.y(), 3, 1.0);
}

TEST(GroundMap, APitIsNoObjectHoweverSteepItsWalls) {
  AnalyticScene dug;
  dug.relief = [](const Vec2& xy_m) {
    return std::abs(xy_m.x() - 5) < 1 && std::abs(xy_m.y() + 3) < 0.8 ? -0.8 : 0.0;
  };
  const GroundMap map = MapOf(dug, {});
  ASSERT_EQ(map.regions.size(), 1u);
  EXPECT_FALSE(map.regions[0].upright);
  EXPECT_LT(map.regions[0].mean_m, -0.3);
}

TEST(PerceivedGround, AHeapIsNotTakenForAnotherMountOfTheSensor) {
  AnalyticScene heaped;
  heaped.relief = Heap_m;
  const PerceptionDiagnosis diagnosis = DiagnoseScans(RecordedBy({}, heaped, {}), 3);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  const PerceptionFinding& found = diagnosis.findings[0];
  EXPECT_EQ(IdOf(found), "terrain_height");
  EXPECT_EQ(found.finding.term.candidate->mechanism->slot, Slot::kGround);
  EXPECT_EQ(TargetOf(found), "ground");
  EXPECT_NEAR(NumberOf(found, "volume_m3"), kHeap_m3, 0.15 * kHeap_m3);
  EXPECT_NEAR(NumberOf(found, "highest_m"), 0.4, 0.03);
  EXPECT_TRUE(found.finding.is_confirmed);
  EXPECT_GT(found.finding.held_out.excess_removed, 0.9);
}

TEST(PerceivedGround, AHeapAndAnotherMountAreToldApart) {
  AnalyticScene heaped;
  heaped.relief = Heap_m;
  LidarOfTest lidar;
  lidar.is.rpy_deg.y() = 1.5;
  const PerceptionDiagnosis diagnosis = DiagnoseScans(RecordedBy(lidar, heaped, {}), 3);
  ASSERT_EQ(diagnosis.findings.size(), 2u);
  EXPECT_EQ(IdOf(diagnosis.findings[0]), "extrinsic");
  EXPECT_EQ(IdOf(diagnosis.findings[1]), "terrain_height");
  EXPECT_NEAR(NumberOf(diagnosis.findings[0], "pitch_deg"), 1.5, 0.1);
  ASSERT_EQ(diagnosis.ground.regions.size(), 1u);
  EXPECT_NEAR(diagnosis.ground.regions[0].volume_m3, kHeap_m3, 0.2 * kHeap_m3);
}

TEST(PerceivedGround, AnObstacleThatIsNotThereIsNamed) {
  AnalyticScene without;
  without.has_box = false;
  const PerceptionDiagnosis diagnosis = DiagnoseScans(RecordedBy({}, without, {}), 3);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  EXPECT_EQ(IdOf(diagnosis.findings[0]), "object_missing");
  EXPECT_EQ(diagnosis.findings[0].finding.term.candidate->mechanism->slot, Slot::kScene);
  EXPECT_EQ(TargetOf(diagnosis.findings[0]), "box1");
  EXPECT_GT(NumberOf(diagnosis.findings[0], "share"), 0.9);
}

TEST(PerceivedAir, DustInOneHalfOfTheTimeIsDustAndNeitherGroundNorSensor) {
  AnalyticScene dusty;
  dusty.has_dust = true;
  dusty.dust_from_s = 12;
  dusty.dust_to_s = 30;
  const PerceptionDiagnosis diagnosis = DiagnoseScans(RecordedBy({}, dusty, {}), 3);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  const PerceptionFinding& found = diagnosis.findings[0];
  EXPECT_EQ(IdOf(found), "dust");
  EXPECT_NEAR((found.place->centre_W_m - dusty.dust_W_m.head<2>()).norm(), 0, 0.4);
  ASSERT_EQ(found.intervals_s.size(), 1u);
  EXPECT_NEAR(found.intervals_s[0].first, 12, 1);
  EXPECT_NEAR(found.intervals_s[0].second, 30, 1);
}

}  // namespace
}  // namespace tera
