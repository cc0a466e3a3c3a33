#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "sim/simulation.h"

/// The shipped drive over the shipped dirt, gravel and loose sand.

namespace tera {
namespace {

/// Speed and sinkage while the whole machine drives on one soil.
struct Strip {
  double from_x_m, to_x_m;
  std::vector<double> speed_mps, sinkage_m;

  static double Mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / values.size();
  }
  double MeanSpeed_mps() const { return Mean(speed_mps); }
  double LeastSpeed_mps() const { return *std::min_element(speed_mps.begin(), speed_mps.end()); }
  /// Standard deviation of the speed over its mean.
  double Variation() const {
    const double mean = MeanSpeed_mps();
    double square = 0;
    for (const double v : speed_mps) square += (v - mean) * (v - mean);
    return std::sqrt(square / speed_mps.size()) / mean;
  }
};

/// The drive from 4 m before the gravel to 7 m behind it, with some keys of the scenario replaced.
struct ThreeSoils : testing::Test {
  // Tracks reach 1.1 m from their middle; borders are at -5 and 5 m.
  Strip dirt{-8, -6.1, {}, {}}, gravel{-3.9, 3.9, {}, {}}, sand{6.1, 12, {}, {}};
  std::vector<double> entering_m;  ///< sinkage, for each half metre over the border of the sand
  Scenario scenario;
  std::unique_ptr<Simulation> simulation;

  void Drive(std::vector<std::string> keys, const std::string& start_m = "[-11, 0.01]") {
    keys.push_back("machines[0].start.xy_m=" + start_m);
    const Config config = Config::FromFile("config/scenarios/drive_three_soils.yaml", keys);
    scenario = ReadScenario(config.root());
    config.Finish();
    simulation = std::make_unique<Simulation>(scenario);
    double x_m = 0;
    do {
      simulation->Step();
      ASSERT_LT(simulation->state().t_ns, FromSeconds(40));
      const MachineState& machine = simulation->state().machines[0];
      x_m = machine.links[0].X_WB.translation().x();
      const double sinkage_m = 0.5 * (machine.gear_sinkage_m[0] + machine.gear_sinkage_m[1]);
      if (x_m > 4.0 + 0.5 * entering_m.size() && x_m < 6.0) entering_m.push_back(sinkage_m);
      for (Strip* strip : {&dirt, &gravel, &sand}) {
        if (x_m < strip->from_x_m || x_m > strip->to_x_m) continue;
        strip->speed_mps.push_back(machine.links[0].v_WB_mps.x());
        strip->sinkage_m.push_back(sinkage_m);
      }
    } while (x_m <= sand.to_x_m);
  }
};

TEST_F(ThreeSoils, SpeedIsSteadyOnDirtAndGravelAndBreaksDownOnSand) {
  Drive({});
  EXPECT_LT(dirt.Variation(), 0.03);
  EXPECT_LT(gravel.Variation(), 0.01);
  EXPECT_GT(dirt.MeanSpeed_mps(), 0.95);
  EXPECT_GT(gravel.MeanSpeed_mps(), 0.97);
  EXPECT_LT(sand.MeanSpeed_mps(), 0.95 * dirt.MeanSpeed_mps());
  EXPECT_LT(sand.LeastSpeed_mps(), 0.85 * dirt.MeanSpeed_mps());
  EXPECT_GT(sand.Variation(), 3 * std::max(dirt.Variation(), gravel.Variation()));
  EXPECT_TRUE(std::is_sorted(entering_m.begin(), entering_m.end()));
  EXPECT_EQ(entering_m.size(), 4u);
  EXPECT_GT(Strip::Mean(sand.sinkage_m), 3 * Strip::Mean(dirt.sinkage_m));
  EXPECT_GT(Strip::Mean(dirt.sinkage_m), Strip::Mean(gravel.sinkage_m));
  // A rut with a ridge on either side, behind each track.
  const TerrainSurface& ground = simulation->ground();
  for (const double track_y_m : {0.01 + 0.574, 0.01 - 0.574}) {
    EXPECT_LT(ground.HeightAt(9, track_y_m), -0.05);
    for (const double side : {1, -1}) {
      double ridge_m = 0;
      for (double out_m = 0.15; out_m < 0.45; out_m += 0.05) {
        ridge_m = std::max<double>(ridge_m, ground.HeightAt(9, track_y_m + side * out_m));
      }
      EXPECT_GT(ridge_m, 0.01);
      EXPECT_LT(ridge_m, 0.10);
    }
  }
}

TEST_F(ThreeSoils, SandThatIsNotLooseSlowsItLessButMoreThanDirtAndGravel) {
  Drive({"terrain.soils=[gravel, dirt, sand]", "terrain.strips[2].soil=sand"});
  EXPECT_LT(sand.MeanSpeed_mps(), 0.97 * dirt.MeanSpeed_mps());
  EXPECT_GT(sand.MeanSpeed_mps(), 0.9 * dirt.MeanSpeed_mps());
  EXPECT_LT(sand.LeastSpeed_mps(), 0.95 * dirt.LeastSpeed_mps());
  EXPECT_GT(sand.Variation(), 2 * std::max(dirt.Variation(), gravel.Variation()));
  EXPECT_GT(Strip::Mean(sand.sinkage_m), 2 * Strip::Mean(dirt.sinkage_m));
}

// Where it comes over the border it is near the end of what it can cross.
TEST_F(ThreeSoils, LooseSandSlowsItAlikeInCellsOfAnySize) {
  std::vector<double> mean_mps, least_mps;
  for (const char* cell_m : {"0.05", "0.04", "0.025"}) {
    sand.speed_mps.clear();
    Drive({std::string("terrain.cell_m=") + cell_m}, "[2, 0]");
    mean_mps.push_back(sand.MeanSpeed_mps());
    least_mps.push_back(sand.LeastSpeed_mps());
    RecordProperty(std::string("mean_and_least_mps_") + cell_m,
                   fmt::format("{:.3f} {:.3f}", mean_mps.back(), least_mps.back()));
  }
  const auto ratio = [](const std::vector<double>& speeds_mps) {
    const auto [low, high] = std::minmax_element(speeds_mps.begin(), speeds_mps.end());
    return *high / *low;
  };
  EXPECT_LT(ratio(mean_mps), 1.1);
  EXPECT_LT(ratio(least_mps), 1.2);
}

TEST_F(ThreeSoils, TheOrderIsTheGroundsAlsoUnderMotorsThatDoNotGiveWay) {
  Drive({"effects.excavator1.left_track.pressure_droop.stall_nm=100000",
         "effects.excavator1.right_track.pressure_droop.stall_nm=100000"});
  EXPECT_LT(std::max(dirt.Variation(), gravel.Variation()), 0.01);
  EXPECT_GT(std::min(dirt.MeanSpeed_mps(), gravel.MeanSpeed_mps()), 0.98);
  EXPECT_LT(sand.MeanSpeed_mps(), dirt.MeanSpeed_mps());
  EXPECT_GT(sand.Variation(), 3 * std::max(dirt.Variation(), gravel.Variation()));
}

}  // namespace
}  // namespace tera
