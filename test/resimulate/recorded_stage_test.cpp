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

/// True joints and tracks at every step.
constexpr char kTrueEncoders[] =
    "{sensors: [{name: encoders, type: encoder, rate_hz: 500, joints: [slew, swing, boom, arm, "
    "bucket, blade, left_track, right_track]}]}";

/// The work of test/sim/work_fixture.h, recorded for 8 s: a bucket dug and dumped, and tracks
/// driven over a plank and soil.
class RecordedWork : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::string rig = kTrueEncoders;
    scenario_ = new Scenario(WorkScenario(
        {"duration_s=8", "machines[0].rig=" + rig, "machines[1].rig=" + rig, "settle_s=1.5"}));
    folder_ = OwnFolder() / "work";
    Generate(*scenario_, "", {.out = folder_});
  }
  static void TearDownTestSuite() { delete scenario_; }

  RecordedWork() : recording_(folder_) {
    for (const ScenarioMachine& machine : scenario_->machines) {
      motions_.emplace_back(machine.placement, machine.placement.name, recording_);
    }
  }

  static const Scenario* scenario_;
  static std::filesystem::path folder_;
  Recording recording_;
  std::vector<RecordedMotion> motions_;
};

const Scenario* RecordedWork::scenario_ = nullptr;
std::filesystem::path RecordedWork::folder_;

/// Volume of soil moved between two grounds: the mean of rise and fall.
double Moved_m3(const std::vector<float>& from_m, const std::vector<float>& to_m, double cell_m) {
  double sum_m = 0;
  for (std::size_t k = 0; k < from_m.size(); ++k) sum_m += std::abs(to_m[k] - from_m[k]);
  return 0.5 * sum_m * cell_m * cell_m;
}

/// The largest distance between a link and its recorded place.
double FarthestLink_m(const MachineState& own, const MachineState& recorded) {
  double farthest_m = 0;
  for (std::size_t l = 0; l < own.links.size(); ++l) {
    const Vec3 off_m = recorded.links[l].X_WB.translation() - own.links[l].X_WB.translation();
    farthest_m = std::max(farthest_m, off_m.norm());
  }
  return farthest_m;
}

/// Cells with another height in the other ground, plus their neighbours if `ring`.
std::vector<bool> Worked(const std::vector<float>& site_m, const std::vector<float>& ground_m,
                         int nx, bool ring) {
  std::vector<bool> worked(site_m.size());
  for (std::size_t k = 0; k < site_m.size(); ++k) {
    if (std::abs(ground_m[k] - site_m[k]) < 1e-6) continue;
    const int reach = ring ? 1 : 0, i = static_cast<int>(k) % nx, j = static_cast<int>(k) / nx;
    const int ny = static_cast<int>(site_m.size()) / nx;
    for (int b = std::max(0, j - reach); b <= std::min(ny - 1, j + reach); ++b) {
      for (int a = std::max(0, i - reach); a <= std::min(nx - 1, i + reach); ++a) {
        worked[static_cast<std::size_t>(b * nx + a)] = true;
      }
    }
  }
  return worked;
}

// A motion repeated to the last bit gives its ground to the last bit
// (test/sim/motion_source_test.cpp). A recording has only poses and angles. Angles are means over
// 50 ms, so that links err by up to 8 mm in acceleration. Rates are differences over 10 ms, without
// the shocks of single steps. The time before t = 0, when the machines came to rest, is missing.
// For that rest alone, 0.3 % of the 0.36 m3 moved lie elsewhere. It is 3.8 % with true links and
// recorded rates, 4.0 % with recorded links and true rates, and 4.1 % with both recorded: loose
// soil ends elsewhere after any small difference.
// The volume elsewhere follows from the links' error d. A surface off by d leaves the area A that
// it works off by at most d on average, up in one place for down in another: d A / 2. The place
// follows too: d is less than a cell, so that the same cells and their neighbours are worked.
TEST_F(RecordedWork, GivesTheGroundOfTheSimulationThatRecordedIt) {
  Simulation simulation(*scenario_);
  double off_m = 0;
  for (int k = 1; simulation.state().t_ns < FromSeconds(8); ++k) {
    simulation.Step();
    if (k % 5 != 0) continue;
    for (std::size_t m = 0; m < motions_.size(); ++m) {
      off_m = std::max(off_m, FarthestLink_m(simulation.state().machines[m],
                                             motions_[m].At(simulation.state().t_ns)));
    }
  }
  EXPECT_LT(off_m, 0.01);
  RecordedStage stage(*scenario_, motions_, 0);
  const RecordedStage::Moment end = stage.AdvanceTo(FromSeconds(8));
  const TerrainSurface& site = scenario_->site->surface();
  const std::vector<float> site_m = HeightsOf(site), own_m = HeightsOf(simulation.ground()),
                           again_m = HeightsOf(*end.ground);
  const double moved_m3 = Moved_m3(site_m, own_m, site.cell_m);
  const double elsewhere_m3 = Moved_m3(own_m, again_m, site.cell_m);
  EXPECT_GT(moved_m3, 0.05);
  const std::vector<bool> worked = Worked(site_m, own_m, site.nx, false);
  const double worked_m2 = static_cast<double>(std::count(worked.begin(), worked.end(), true)) *
                           site.cell_m * site.cell_m;
  EXPECT_LT(elsewhere_m3, 0.5 * off_m * worked_m2);
  const std::vector<bool> near = Worked(site_m, own_m, site.nx, true);
  std::vector<float> far_m = own_m;
  for (std::size_t k = 0; k < far_m.size(); ++k) {
    if (!near[k]) far_m[k] = again_m[k];
  }
  EXPECT_LT(Moved_m3(own_m, far_m, site.cell_m), 1e-3 * moved_m3);  // crumbs that rolled on
  RecordProperty("off_m", std::to_string(off_m));
  RecordProperty("worked_m2", std::to_string(worked_m2));
  RecordProperty("moved_m3", std::to_string(moved_m3));
  RecordProperty("elsewhere_m3", std::to_string(elsewhere_m3));
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
  // More than a cell within its edges.
  for (double x_m = 0.15 - 0.5 * box.size_m.x(); x_m < 0.5 * box.size_m.x() - 0.15; x_m += 0.1) {
    for (double y_m = 0.15 - 0.5 * box.size_m.y(); y_m < 0.5 * box.size_m.y() - 0.15; y_m += 0.1) {
      const Vec3 p_W_m = X_WB * Vec3(x_m, y_m, 0);
      const double site_m = site.HeightAt(p_W_m.x(), p_W_m.y());
      if (site_m > top_m - 0.03) continue;  // the ground rises out of the plank
      // Soil thrown aside by tracks and blade may lie on it.
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
      EXPECT_LT(FarthestLink_m(own, again), 0.01) << t_s << ' ' << m;
      const double own_kg = own.shovel_load[0].mass_kg;
      EXPECT_NEAR(again.shovel_load[0].mass_kg, own_kg, 5 + 0.1 * own_kg) << t_s << ' ' << m;
    }
  }
}

}  // namespace
}  // namespace tera
