#include "sim/task/task.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/config/config.h"
#include "core/faults.h"
#include "sim/scenario/scenario_text.h"

namespace tera {
namespace {

using enum FaultKind;

/// Level ground of 12 m, x and y from -6 to 6 m, with a step of 0.4 m at x = 0.
TerrainSurface SteppedGround() {
  TerrainGrid grid;
  grid.origin_W_m = Vec2(-6, -6);
  grid.cell_m = 0.1;
  grid.nx = grid.ny = 121;
  TerrainSurface ground(grid);
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 61; i < grid.nx; ++i) ground.Set(i, j, {.height_m = 0.4F, .cover = {}});
  }
  return ground;
}

std::optional<Task> Read(const std::string& yaml, const TerrainSurface& ground) {
  const Config config = Config::FromText(yaml, "task.yaml");
  std::optional<Task> task = ReadTask(config.root(), ground);
  config.Finish();
  return task;
}

std::vector<InputFault> Faults(const std::string& yaml) {
  const TerrainSurface ground = SteppedGround();
  return FaultsIn([&] { Read(yaml, ground); });
}

TEST(ReadTask, RunsTheFloorOfATrenchFromDepthToDepth) {
  const auto task =
      Read("{trench: {from_m: [-2, 1], to_m: [2, 1], width_m: 1, depth_m: 0.8}}", SteppedGround());
  EXPECT_NEAR(*task->design.HeightAt({-2, 1}), -0.8, 1e-6);
  EXPECT_NEAR(*task->design.HeightAt({1.999, 1}), -0.4, 1e-3);
  EXPECT_NEAR(*task->design.HeightAt({0, 1.49}), -0.6, 1e-6);
  EXPECT_FALSE(task->design.HeightAt({0, 1.51}));
}

TEST(ReadTask, SetsThePitBelowItsLowestCorner) {
  const auto task = Read(
      "{pit: {corners_m: [[-1, -1], [1, -1], [1, 1], [-1, 1]], depth_m: 0.5, side_slope_deg: 45}}",
      SteppedGround());
  EXPECT_NEAR(*task->design.HeightAt({0.5, 0.5}), -0.5, 1e-6);
  EXPECT_NEAR(*task->design.HeightAt({1.3, 0}), -0.2, 1e-6);
}

TEST(ReadTask, RefusesATrenchWithoutWidthDepthOrLength) {
  EXPECT_THAT(Faults("{trench: {from_m: [0, 0], to_m: [2, 0], width_m: 0, depth_m: 1}}"),
              HasOnlyFault(kOutOfRange, "trench.width_m"));
  EXPECT_THAT(Faults("{trench: {from_m: [0, 0], to_m: [2, 0], width_m: 1, depth_m: 0}}"),
              HasOnlyFault(kOutOfRange, "trench.depth_m"));
  EXPECT_THAT(Faults("{trench: {from_m: [1, 1], to_m: [1, 1], width_m: 1, depth_m: 1}}"),
              HasOnlyFault(kInconsistent, "trench.to_m"));
}

TEST(ReadTask, RefusesADesignBeyondTheSite) {
  EXPECT_THAT(Faults("{trench: {from_m: [0, 0], to_m: [6.5, 0], width_m: 1, depth_m: 1}}"),
              HasOnlyFault(kOutOfRange, "trench.to_m"));
  // The floor ends at 5.5 m; sides of 45 degrees and 1 m depth end at 6.5 m.
  EXPECT_THAT(Faults("{trench: {from_m: [-5.5, 0], to_m: [2, 0], width_m: 1, depth_m: 1, "
                     "side_slope_deg: 45}}"),
              HasOnlyFault(kOutOfRange, "trench.from_m"));
  EXPECT_THAT(Faults("{pit: {corners_m: [[0, 0], [1, 0], [0, 9]], depth_m: 1}}"),
              HasOnlyFault(kOutOfRange, "pit.corners_m"));
}

TEST(ReadTask, RefusesAPitWhoseSidesCross) {
  EXPECT_THAT(Faults("{pit: {corners_m: [[0, 0], [1, 1], [1, 0], [0, 1]], depth_m: 1}}"),
              HasOnlyFault(kInconsistent, "pit.corners_m"));
}

TEST(ReadTask, RefusesAFloorWithoutColumns) {
  // Columns are at multiples of 0.1 m, and the floor's are half a cell within its edge.
  const auto trench = [](double y_m, double width_m) {
    return fmt::format(
        "{{trench: {{from_m: [-3, {0}], to_m: [-1, {0}], width_m: {1}, depth_m: 1}}}}", y_m,
        width_m);
  };
  EXPECT_THAT(Faults(trench(1, 0.09)), HasOnlyFault(kOutOfRange, "trench.width_m"));
  EXPECT_THAT(Faults(trench(1, 0.11)), testing::IsEmpty());
  EXPECT_THAT(Faults(trench(1.05, 0.19)), HasOnlyFault(kOutOfRange, "trench.width_m"));
  EXPECT_THAT(Faults(trench(1.05, 0.21)), testing::IsEmpty());
  EXPECT_THAT(Faults("{pit: {corners_m: [[-2.98, 1.01], [-2.7, 1.01], [-2.98, 1.2]], depth_m: 1}}"),
              HasOnlyFault(kOutOfRange, "pit.corners_m"));
}

TEST(ReadTask, RefusesAFloorAboveTheGround) {
  // A basin of 2 m around which the pit's corners stand.
  TerrainSurface ground = SteppedGround();
  for (int j = 41; j < 80; ++j) {
    for (int i = 11; i < 50; ++i) ground.Set(i, j, {.height_m = -2, .cover = {}});
  }
  const auto faults = FaultsIn([&] {
    Read("{pit: {corners_m: [[-5, -2], [-1, -2], [-1, 2], [-5, 2]], depth_m: 1}}", ground);
  });
  EXPECT_THAT(faults, HasOnlyFault(kOutOfRange, "pit.corners_m"));
}

TEST(ReadTask, RefusesNoDesignAndTwo) {
  EXPECT_THAT(Faults("{tolerance_m: 0.05}"), HasFault(kMissing));
  EXPECT_THAT(Faults("{pit: {corners_m: [[0, 0], [1, 0], [0, 1]], depth_m: 1}, "
                     "trench: {from_m: [0, 0], to_m: [2, 0], width_m: 1, depth_m: 1}}"),
              HasFault(kRepeated));
}

TEST(ReadTask, IsReadFromAScenario) {
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + kExcavator +
                             "task: {trench: {from_m: [0, 0], to_m: [9, 0], width_m: 0, "
                             "depth_m: 1}}\n"),
              testing::AllOf(HasFault(kOutOfRange, "task.trench.width_m"),
                             HasFault(kOutOfRange, "task.trench.to_m")));
}

/// A floor of 2 x 1 m in cells of 0.1 m: columns at its edge belong to the design's volumes, but
/// only those of 1.8 x 0.8 m between them and half a cell to the floor.
class TrenchOfOneMetre : public ::testing::Test {
 protected:
  TrenchOfOneMetre()
      : ground_(SteppedGround()),
        task_(
            *Read("{trench: {from_m: [-4.05, 0.05], to_m: [-2.05, 0.05], width_m: 1, depth_m: 1}}",
                  ground_)),
        columns_(task_, ground_) {}
  /// Sets the ground of x from `from_m` to `to_m` to a height, across the trench.
  void SetGround(double from_m, double to_m, float height_m) {
    for (int j = 0; j < ground_.ny; ++j) {
      for (int i = 0; i < ground_.nx; ++i) {
        const bool in = ground_.x_m(i) > from_m && ground_.x_m(i) < to_m &&
                        std::abs(ground_.y_m(j) - 0.05) < 0.5;
        if (in) ground_.Set(i, j, {.height_m = height_m, .cover = {}});
      }
    }
  }
  TerrainSurface ground_;
  Task task_;
  TaskColumns columns_;
};

TEST_F(TrenchOfOneMetre, HasItsWholeVolumeToCutAtFirst) {
  const TaskDeviation start = columns_.Compare(ground_);
  EXPECT_NEAR(start.to_cut_m3, 2.0, 1e-6);
  EXPECT_EQ(start.cut_beyond_m3, 0);
  EXPECT_EQ(start.within, 0);
  EXPECT_NEAR(start.highest_m, 1, 1e-6);
}

TEST(TaskColumns, BelongToTheFloorFromHalfACellWithinASlantedEdgeOn) {
  // Across the diagonal, columns are on lines 0.0707 m apart. The seventh from the middle is
  // 0.055 m within the edge at 0.55 m: a corner of its squares is beyond it.
  const TerrainSurface ground = SteppedGround();
  const auto task =
      Read("{trench: {from_m: [-4, -4], to_m: [-2, -2], width_m: 1.1, depth_m: 1}}", ground);
  const TaskColumns columns(*task, ground);
  const auto dug_lines = [&](double lines) {
    TerrainSurface dug = ground;
    columns.ForEach([&](int i, int j, double design_m) {
      const double offset_m = std::sqrt(0.5) * std::abs(ground.x_m(i) - ground.y_m(j));
      if (offset_m > lines * std::sqrt(0.5) * ground.cell_m) return;
      dug.Set(i, j, {.height_m = static_cast<float>(design_m), .cover = {}});
    });
    return columns.Compare(dug);
  };
  EXPECT_LT(dug_lines(6.5).within, 1);
  EXPECT_EQ(dug_lines(7.5).within, 1);
}

TEST_F(TrenchOfOneMetre, CountsWhatIsLeftAndWhatIsCutBeyond) {
  SetGround(-4.05, -3.05, -1.04F);  // half of it 4 cm too deep
  SetGround(-3.05, -2.55, -0.9F);   // a quarter 10 cm too high; a quarter untouched
  const TaskDeviation half = columns_.Compare(ground_);
  EXPECT_NEAR(half.cut_beyond_m3, 1.0 * 0.04, 1e-6);
  EXPECT_NEAR(half.to_cut_m3, 0.5 * 0.1 + 0.5 * 1.0, 1e-6);
  EXPECT_NEAR(half.within, 0.5, 1e-9);
  EXPECT_NEAR(half.lowest_m, -0.04, 1e-6);
  EXPECT_NEAR(half.highest_m, 1.0, 1e-6);
  EXPECT_NEAR(half.rms_m, std::sqrt(0.5 * 0.0016 + 0.25 * 0.01 + 0.25), 1e-6);
}

}  // namespace
}  // namespace tera
