#include "resimulate/motion/recorded_machines.h"

#include <gtest/gtest.h>

#include "dataset/format/sample_recording.h"
#include "resimulate/recorded_cart.h"
#include "soil/soil.h"

namespace tera {
namespace {

constexpr std::size_t kCart = 0, kDigger = 1;
constexpr int kMast = 1;
constexpr double kDt_s = 0.002;

/// From (1, 2, 0.5) in 4 s to (5, 0, 0.5), turned left by 30 deg: 1 m/s along x, 0.5 m/s back
/// along y.
Pose Straight(double t_s) {
  return MakePose(Vec3(1 + (t_s - 1), 2 - 0.5 * (t_s - 1), 0.5), RotationFromRpy(0, 0, 30 * kDeg));
}
double Turn(double t_s) { return 0.2 * t_s; }

/// The cart, recorded from 1 to 5 s, and an unrecorded excavator.
class MachinesOfARecording : public testing::Test {
 protected:
  MachinesOfARecording() {
    const RecordedCart cart{.pose_t_ns = EvenTimes(1, 5, 0.01),
                            .turn_t_ns = EvenTimes(1, 5, 0.01),
                            .X_WB = Straight,
                            .turn_rad = Turn};
    const Recording recording = WriteCart(scratch_.path() / "r", cart);
    motions_.emplace_back(scenario_.machines[kCart].placement, cart.machine, recording);
    motions_.emplace_back(scenario_.machines[kDigger].placement, "digger", recording);
  }

  void Start(double t_s) { machines_.Start({FromSeconds(t_s), -100}, &world_); }
  void MoveTo(double t_s) { machines_.Move({FromSeconds(t_s), kDt_s, reactions_}, &world_); }
  void ExpectTheCartStandsAsAt(double t_s) const {
    for (const BodyState& link : world_.machines[kCart].links) {
      EXPECT_EQ(link.v_WB_mps, Vec3(0, 0, 0));
      EXPECT_EQ(link.w_WB_radps, Vec3(0, 0, 0));
    }
    EXPECT_LT(OffBy_m(t_s), 1e-6);
  }
  double OffBy_m(double t_s) const {
    const Pose& X_WB = world_.machines[kCart].links[0].X_WB;
    return (X_WB.translation() - Straight(t_s).translation()).norm();
  }

  const ScratchDirectory scratch_;
  const Scenario scenario_ = CartScenario(scratch_.path(), R"(
  - name: digger
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [-4, 3], yaw_deg: 50}
    operator: {type: idle}
)");
  std::vector<RecordedMotion> motions_;
  RecordedMachines machines_{scenario_, motions_};
  WorldState world_{MakeSoil(*scenario_.site, 1)};
  std::vector<SoilReaction> reactions_{2};
};

TEST_F(MachinesOfARecording, StandBeforeTheStartWhereTheyAreThen) {
  Start(2);
  ExpectTheCartStandsAsAt(2);
  MoveTo(1.9);  // while others settle
  ExpectTheCartStandsAsAt(2);
}

TEST_F(MachinesOfARecording, MoveFromTheStartOnAsTheyDid) {
  Start(2);
  for (const double t_s : {2.0, 2.002, 3.5}) {
    MoveTo(t_s);
    const MachineState& cart = world_.machines[kCart];
    EXPECT_LT(OffBy_m(t_s), 1e-6) << t_s;
    EXPECT_LT((cart.links[0].v_WB_mps - Vec3(1, -0.5, 0)).norm(), 1e-4) << t_s;
    EXPECT_NEAR(cart.links[kMast].w_WB_radps.z(), 0.2, 1e-4) << t_s;
    EXPECT_NEAR(cart.q_rad[0], Turn(t_s), 1e-9) << t_s;
  }
}

TEST_F(MachinesOfARecording, MoveWhateverTheGroundSays) {
  Wrench push;
  push.force_W_n = Vec3(3e4, -2e4, 5e4);
  reactions_[kCart].link_wrench.assign(2, push);
  Start(2);
  MoveTo(2.5);
  EXPECT_LT(OffBy_m(2.5), 1e-6);
}

TEST_F(MachinesOfARecording, HaveAnEmptyLoadForEachShovelAtTheStart) {
  Start(2);
  EXPECT_TRUE(world_.machines[kCart].shovel_load.empty());
  ASSERT_EQ(world_.machines[kDigger].shovel_load.size(), 2u);  // bucket and blade
  for (const auto& load : world_.machines[kDigger].shovel_load) EXPECT_EQ(load.mass_kg, 0);
}

TEST_F(MachinesOfARecording, CarryWhatTheGroundGaveThemUntilItSaysOtherwise) {
  Start(2);
  SoilReaction::Load load;
  load.mass_kg = 120;
  reactions_[kDigger].shovel_load = {load, {}};
  MoveTo(2.1);
  EXPECT_EQ(world_.machines[kDigger].shovel_load.at(0).mass_kg, 120);
  reactions_[kDigger].shovel_load.clear();  // an unknown machine does not touch the ground
  MoveTo(2.2);
  EXPECT_EQ(world_.machines[kDigger].shovel_load.at(0).mass_kg, 120);
  load.mass_kg = 0;
  reactions_[kDigger].shovel_load = {load, {}};
  MoveTo(2.3);
  EXPECT_EQ(world_.machines[kDigger].shovel_load.at(0).mass_kg, 0);
}

TEST_F(MachinesOfARecording, AreKnownWhileTheyWaitForTheStartAndAsLongAsTheRecordingGoesOn) {
  Start(2);
  EXPECT_TRUE(machines_.IsKnown(kCart));
  MoveTo(0.2);  // before anything was recorded
  EXPECT_TRUE(machines_.IsKnown(kCart));
  MoveTo(4.9);
  EXPECT_TRUE(machines_.IsKnown(kCart));
  MoveTo(6);
  EXPECT_FALSE(machines_.IsKnown(kCart));
}

TEST_F(MachinesOfARecording, AreNotKnownWhereTheStartLiesBeforeTheRecording) {
  Start(0.5);
  EXPECT_FALSE(machines_.IsKnown(kCart));
  MoveTo(1.5);
  EXPECT_TRUE(machines_.IsKnown(kCart));
}

TEST_F(MachinesOfARecording, OfWhichNothingWasRecordedAreNotKnownAndStayWhereTheyWerePlaced) {
  Start(2);
  MoveTo(3);
  EXPECT_FALSE(machines_.IsKnown(kDigger));
  const Vec2 at_m = world_.machines[kDigger].links[0].X_WB.translation().head<2>();
  EXPECT_LT((at_m - Vec2(-4, 3)).norm(), 1e-9);
}

}  // namespace
}  // namespace tera
