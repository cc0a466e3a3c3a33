#include "sim/motion_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "work_fixture.h"

namespace tera {
namespace {

/// Machines that follow given states, one for each step.
class RecordedStates : public MotionSource {
 public:
  explicit RecordedStates(std::vector<std::vector<MachineState>> states)
      : states_(std::move(states)) {}
  void Start(const Begin&, WorldState* world) override { world->machines = states_.at(0); }
  void Move(const Step&, WorldState* world) override { world->machines = states_.at(++step_); }
  bool IsKnown(std::size_t) const override { return true; }

 private:
  std::vector<std::vector<MachineState>> states_;
  std::size_t step_ = 0;
};

// The ground follows only from poses and rates of links and gears. Equal ones at every step give an
// equal ground to the last bit, as well as equal obstacles and beds.
TEST(MotionSource, AMotionSteppedAgainGivesItsOwnGround) {
  constexpr int kSteps = 5000;                             // dug, and dumped into the truck
  const Scenario scenario = WorkScenario({"settle_s=0"});  // states before t = 0 are not shown
  Simulation driven(scenario);
  std::vector<std::vector<MachineState>> states = {driven.state().machines};
  for (int k = 0; k < kSteps; ++k) {
    driven.Step();
    states.push_back(driven.state().machines);
  }
  Simulation again(scenario, std::make_unique<RecordedStates>(std::move(states)));
  for (int k = 0; k < kSteps; ++k) again.Step();
  EXPECT_EQ(again.state().t_ns, driven.state().t_ns);
  EXPECT_TRUE(HeightsOf(again.ground()) == HeightsOf(driven.ground()));
  const MassLedger was = driven.state().ground().ledger(), is = again.state().ground().ledger();
  EXPECT_GT(was.shifted_kg + was.carried_kg, 20);
  EXPECT_EQ(is.shifted_kg, was.shifted_kg);
  EXPECT_EQ(is.beds_kg, was.beds_kg);
  EXPECT_EQ(is.carried_kg, was.carried_kg);
  EXPECT_EQ(again.state().beds[0].mass_kg, driven.state().beds[0].mass_kg);
  for (std::size_t o = 0; o < scenario.obstacles.size(); ++o) {
    if (scenario.obstacles[o].dynamic) continue;  // physics alone moves it
    EXPECT_TRUE(again.state().obstacles[o].X_WB.matrix() ==
                driven.state().obstacles[o].X_WB.matrix());
  }
}

/// A machine that moves at 1 m/s along x over ground that it should compress, and back.
class Glide : public MotionSource {
 public:
  Glide(MachineState start, bool known) : state_(std::move(start)), known_(known) {}
  void Start(const Begin&, WorldState* world) override { world->machines = {state_}; }
  void Move(const Step& step, WorldState* world) override {
    for (BodyState& link : state_.links) {
      link.v_WB_mps = Vec3(1, 0, 0);
      link.X_WB.translation() += step.dt_s * link.v_WB_mps;
    }
    world->machines = {state_};
  }
  bool IsKnown(std::size_t) const override { return known_; }

 private:
  MachineState state_;
  bool known_;
};

TEST(MotionSource, AMachineOfWhichNothingIsKnownLeavesTheGroundAlone) {
  Scenario scenario = WorkScenario();
  scenario.machines.erase(scenario.machines.begin());
  const Simulation standing(scenario);
  MachineState low = standing.state().machines[0];
  for (BodyState& link : low.links) link.X_WB.translation().z() -= 0.05;
  for (const bool known : {true, false}) {
    Simulation simulation(scenario, std::make_unique<Glide>(low, known));
    for (int k = 0; k < 500; ++k) simulation.Step();
    const bool as_it_was = HeightsOf(simulation.ground()) == HeightsOf(scenario.site->surface());
    EXPECT_EQ(as_it_was, !known);
  }
}

TEST(MotionSource, TimesCountFromTheStartThatIsGiven) {
  Scenario scenario = WorkScenario({"settle_s=0.1"});
  scenario.machines.erase(scenario.machines.begin());
  const Simulation standing(scenario);
  const TimeNs start_ns = 7'000'000'123;
  Simulation simulation(scenario, std::make_unique<Glide>(standing.state().machines[0], true),
                        start_ns);
  EXPECT_EQ(simulation.state().t_ns, start_ns);
  for (int k = 0; k < 250; ++k) simulation.Step();
  EXPECT_EQ(simulation.state().t_ns, start_ns + 500'000'000);
  // The truck's place on its path at 7.5 s: 5.5 / 7 of it.
  const Vec2 at_m = simulation.state().obstacles[0].X_WB.translation().head<2>();
  EXPECT_NEAR((at_m - Vec2(-3.5 + 1.5 * 5.5 / 7, 5 + 0.5 * 5.5 / 7)).norm(), 0, 1e-6);
}

}  // namespace
}  // namespace tera
