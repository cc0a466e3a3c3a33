#include "resimulate/recorded_stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "own_folder.h"
#include "sim/run/generate.h"
#include "sim/work_fixture.h"

namespace tera {
namespace {

/// Joints and tracks as they are, at every step.
constexpr char kTrueEncoders[] =
    "{sensors: [{name: encoders, type: encoder, rate_hz: 500, joints: [slew, swing, boom, arm, "
    "bucket, blade, left_track, right_track]}]}";

/// The work of test/sim/work_fixture.h, recorded for 8 s: a bucket dug and dumped, tracks driven
/// over a plank and over soil.
class RecordedWork : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::string rig = kTrueEncoders;
    scenario_ = new Scenario(WorkScenario(
        {"duration_s=8", "machines[0].rig=" + rig, "machines[1].rig=" + rig, "settle_s=1.5"}));
    Generate(*scenario_, "", {.out = OwnFolder() / "work"});
  }
  static void TearDownTestSuite() { delete scenario_; }

  RecordedWork() : recording_(OwnFolder() / "work") {
    for (const ScenarioMachine& machine : scenario_->machines) {
      motions_.emplace_back(machine.placement, machine.placement.name, recording_);
    }
  }

  static const Scenario* scenario_;
  Recording recording_;
  std::vector<RecordedMotion> motions_;
};

const Scenario* RecordedWork::scenario_ = nullptr;

/// Soil that was moved from one ground to another: the mean of what rose and what fell.
double Moved_m3(const std::vector<float>& from_m, const std::vector<float>& to_m, double cell_m) {
  double sum_m = 0;
  for (std::size_t k = 0; k < from_m.size(); ++k) sum_m += std::abs(to_m[k] - from_m[k]);
  return 0.5 * sum_m * cell_m * cell_m;
}

// A motion that is stepped again to the last bit gives its ground to the last bit
// (test/sim/motion_source_test.cpp). A recording has poses and angles, not rates, which are taken
// from differences over 10 ms, and nothing from before t = 0, when the machines came to rest: a
// small share of what was moved lies elsewhere.
TEST_F(RecordedWork, GivesTheGroundOfTheSimulationThatRecordedIt) {
  Simulation simulation(*scenario_);
  while (simulation.state().t_ns < FromSeconds(8)) simulation.Step();
  RecordedStage stage(*scenario_, motions_, 0);
  const RecordedStage::Moment end = stage.AdvanceTo(FromSeconds(8));
  const std::vector<float> site_m = HeightsOf(scenario_->site->surface());
  const std::vector<float> own_m = HeightsOf(simulation.ground());
  const std::vector<float> again_m = HeightsOf(*end.ground);
  const double cell_m = scenario_->site->surface().cell_m;
  const double moved_m3 = Moved_m3(site_m, own_m, cell_m);
  const double elsewhere_m3 = Moved_m3(own_m, again_m, cell_m);
  RecordProperty("moved_m3", std::to_string(moved_m3));
  RecordProperty("elsewhere_m3", std::to_string(elsewhere_m3));
  EXPECT_GT(moved_m3, 0.05);
  EXPECT_LT(elsewhere_m3, 0.1 * moved_m3);
}

TEST_F(RecordedWork, PressesNoGroundUnderAPlankThatTracksClimb) {
  RecordedStage stage(*scenario_, motions_, 0);
  const RecordedStage::Moment end = stage.AdvanceTo(FromSeconds(8));
  const ScenarioObstacle& plank = scenario_->obstacles.at(1);
  const CollisionBox& box = plank.collision.at(0);
  const Pose X_WB =
      MakePose(Vec3(plank.xy_W_m.x(), plank.xy_W_m.y(), 0), RotationFromRpy(0, 0, plank.yaw_rad));
  const TerrainSurface& site = scenario_->site->surface();
  const double top_m =
      site.HeightAt(plank.xy_W_m.x(), plank.xy_W_m.y()) + box.size_m.z();  // it lies on the ground
  int places = 0;
  // A cell and more within its edges.
  for (double x_m = 0.15 - 0.5 * box.size_m.x(); x_m < 0.5 * box.size_m.x() - 0.15; x_m += 0.1) {
    for (double y_m = 0.15 - 0.5 * box.size_m.y(); y_m < 0.5 * box.size_m.y() - 0.15; y_m += 0.1) {
      const Vec3 p_W_m = X_WB * Vec3(x_m, y_m, 0);
      const double site_m = site.HeightAt(p_W_m.x(), p_W_m.y());
      if (site_m > top_m - 0.03) continue;  // the ground rises out of the plank
      // What tracks and blade throw aside may lie on it.
      EXPECT_GT(end.ground->HeightAt(p_W_m.x(), p_W_m.y()), site_m - 1e-6) << x_m << ' ' << y_m;
      ++places;
    }
  }
  EXPECT_GT(places, 20);
}

TEST_F(RecordedWork, StandsWhereTheRecordingHasItAndCarriesWhatWasDug) {
  Simulation simulation(*scenario_);
  RecordedStage stage(*scenario_, motions_, 0);
  for (const double t_s : {1.0, 3.5, 5.0}) {
    while (simulation.state().t_ns < FromSeconds(t_s)) simulation.Step();
    const RecordedStage::Moment moment = stage.AdvanceTo(FromSeconds(t_s));
    const Instant state = stage.StateAt(FromSeconds(t_s), moment);
    for (std::size_t m = 0; m < motions_.size(); ++m) {
      const MachineState &own = simulation.state().machines[m], &again = state.machines[m];
      for (std::size_t l = 0; l < own.links.size(); ++l) {
        const Vec3 off_m = again.links[l].X_WB.translation() - own.links[l].X_WB.translation();
        EXPECT_LT(off_m.norm(), 0.01) << t_s << ' ' << m << ' ' << l;
      }
      const double own_kg = own.shovel_load[0].mass_kg;
      EXPECT_NEAR(again.shovel_load[0].mass_kg, own_kg, 5 + 0.1 * own_kg) << t_s << ' ' << m;
    }
  }
}

}  // namespace
}  // namespace tera
