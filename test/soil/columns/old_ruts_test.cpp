#include "soil/columns/old_ruts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/faults.h"
#include "soil/site/site_fixture.h"

namespace tera {
namespace {

using enum FaultKind;
using namespace testing_soil;

TEST(OldRuts, TwoRunHalfTheGaugeBesideThePathAndNothingBetween) {
  const auto soil = MakeGround(
      "size_m: [12, 12]\ncell_m: 0.05\nsoil: dirt\n"
      "ruts: [{path_m: [[-9, -1], [0, -1], [0, 9]], gauge_m: 2, width_m: 0.4, depth_m: 0.05}]\n");
  const TerrainSurface& ground = soil->surface();
  for (const double x : {-5.0, -3.0}) {
    EXPECT_NEAR(ground.HeightAt(x, 0), -0.05, 1e-6) << "left of a path towards +x";
    EXPECT_NEAR(ground.HeightAt(x, -2), -0.05, 1e-6);
    EXPECT_NEAR(ground.HeightAt(x, -1), 0, 1e-9) << "between them";
    EXPECT_NEAR(ground.HeightAt(x, 0.5), 0, 1e-9) << "outside";
  }
  EXPECT_NEAR(ground.HeightAt(1, 4), -0.05, 1e-6);
  EXPECT_NEAR(ground.HeightAt(-1, 4), -0.05, 1e-6);
  EXPECT_NEAR(ground.HeightAt(0, 4), 0, 1e-9);
  const int i = static_cast<int>(std::lround((-3 - ground.origin_W_m.x()) / ground.cell_m));
  const int j = static_cast<int>(std::lround((0 - ground.origin_W_m.y()) / ground.cell_m));
  EXPECT_EQ(ground.at(i, j).cover.rut, 255) << "it looks pressed";
}

TEST(OldRuts, MassIsKeptWhereSoilIsSqueezedOutBesideThem) {
  const auto soil = MakeGround(
      "size_m: [8, 8]\ncell_m: 0.05\nsoil: sand\n"
      "ruts: [{path_m: [[-2, 0], [2, 0]], width_m: 0.3, depth_m: 0.2}]\n");
  EXPECT_NEAR(soil->ledger().total_kg(), 0, 1e-6);
  double highest_m = 0;
  for (double y = 0.15; y < 0.5; y += 0.05) {
    highest_m = std::max(highest_m, soil->surface().HeightAt(0, y));
  }
  EXPECT_GT(highest_m, 0.01) << "a ridge beside the rut";
  EXPECT_LT(soil->surface().HeightAt(0, 0), -0.15);
}

TEST(OldRuts, EveryFaultIsNamed) {
  EXPECT_THAT(FaultsOf("ruts: [{path_m: [[0, 0]], width_m: 0.3, depth_m: 0.1}]\n"),
              HasFault(kOutOfRange, "ruts[0].path_m"));
  EXPECT_THAT(FaultsOf("ruts: [{path_m: [[0, 0], [1, 0]], width_m: 0.3, depth_m: 0.8}]\n"),
              HasFault(kOutOfRange, "ruts[0].depth_m"));
  EXPECT_THAT(FaultsOf("ruts: [{path_m: [[0, 0], [1, 0]], width_m: 9, depth_m: 0.1}]\n"),
              HasFault(kOutOfRange, "ruts[0].width_m"));
  EXPECT_THAT(FaultsOf("ruts: [{path_m: [[-1e12, 0], [1e12, 0]], width_m: 0.3, depth_m: 0.1}]\n"),
              HasFaultAt("ruts[0].path_m"));
  EXPECT_THAT(
      FaultsOf("ruts: [{path_m: [[0, 0], [1, 0]], gauge_m: 0.2, width_m: 0.3, depth_m: 0.1}]\n"),
      HasFault(kOutOfRange, "ruts[0].gauge_m"));
}

}  // namespace
}  // namespace tera
