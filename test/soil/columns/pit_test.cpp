#include "soil/columns/pit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/faults.h"
#include "core/units.h"
#include "soil/site/site_fixture.h"

namespace tera {
namespace {

using enum FaultKind;
using namespace testing_soil;

TEST(Pit, IsAsDeepAsItSaysWithinItsOutlineAndNowhereElse) {
  const auto soil = MakeGround(
      "size_m: [10, 10]\nsoil: clay\nrelief: {slope_deg: 5, slope_direction_deg: 90}\n"
      "pits: [{outline_m: [[1, -2], [4, -2], [4, 3]], depth_m: 0.8}]\n");
  const TerrainSurface& ground = soil->surface();
  const auto before_m = [](double y_m) { return y_m * std::tan(5 * kDeg); };
  EXPECT_NEAR(ground.HeightAt(3.5, 0), before_m(0) - 0.8, 1e-6);
  EXPECT_NEAR(ground.HeightAt(1.5, 0), before_m(0), 1e-6);  // beyond the slanting side
  EXPECT_NEAR(ground.HeightAt(3.5, -2.2), before_m(-2.2), 1e-6);
  EXPECT_EQ(soil->ledger().ground_kg, 0);  // dug soil is not of this site
}

TEST(Pit, WallsOfClayStandAtOneMetreAndFailAtOnePointFourAndSandSlumps) {
  const std::string pits =
      "size_m: [10, 10]\ncell_m: 0.1\npits:\n"
      "  - {outline_m: [[-3.95, -3], [-1.95, -3], [-1.95, 3], [-3.95, 3]], depth_m: 1.0}\n"
      "  - {outline_m: [[1.95, -3], [3.95, -3], [3.95, 3], [1.95, 3]], depth_m: 1.4}\n";
  const auto clay = MakeGround("soil: clay\n" + pits), sand = MakeGround("soil: sand\n" + pits);
  for (int k = 0; k < 1500; ++k) {
    clay->Flow(0.002);
    sand->Flow(0.002);
  }
  EXPECT_EQ(clay->surface().HeightAt(-1.7, 0), 0);  // 0.2 m behind the low wall
  EXPECT_NEAR(clay->surface().HeightAt(-3, 0), -1.0, 1e-6);
  EXPECT_LT(clay->surface().HeightAt(1.7, 0), -0.2);  // and behind the high one
  EXPECT_LT(sand->surface().HeightAt(-1.7, 0), -0.2);
  EXPECT_LT(sand->surface().HeightAt(1.7, 0), -0.2);
  // The pits' sides lose wedges of 1.4 m over a plane at 51.5 deg, over a perimeter of 16 m.
  const double fallen_kg = 0.5 * 1.4 * 1.4 / std::tan(51.5 * kDeg) * 16 * 1790;
  EXPECT_NEAR(clay->ledger().total_kg() / fallen_kg, 0, 1e-12);
}

TEST(Pit, EveryFaultIsNamed) {
  EXPECT_THAT(FaultsOf("pits: [{outline_m: [[0, 0], [1, 0], [1, 1]], depth_m: -1}]\n"),
              HasFault(kOutOfRange, "pits[0].depth_m"));
  EXPECT_THAT(FaultsOf("pits: [{outline_m: [[0, 0], [1, 1], [1, 0], [0, 1]], depth_m: 1}]\n"),
              HasFaultAt("pits[0].outline_m"));
  EXPECT_THAT(FaultsOf("size_m: [4, 4]\npits: [{outline_m: [[0, 0], [3, 0], [1, 1]], depth_m: 1}]"),
              HasFault(kOutOfRange, "pits[0].outline_m"));
  EXPECT_THAT(FaultsOf("pits: [{depth_m: 1}]\n"), HasFaultAt("pits[0].outline_m"));
}

}  // namespace
}  // namespace tera
