#include "sim/operators/operator_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/config/config.h"
#include "core/faults.h"
#include "core/units.h"
#include "own_folder.h"
#include "sim/operators/planar_arm.h"

namespace tera {
namespace {

using enum FaultKind;

/// A machine with a left and a right wheel, 1 m apart, 2 m/s at full lever.
struct Cart {
  MachineModel model;
  MachineState state;
  TerrainSurface ground;

  Cart() {
    model.kind = "cart";
    model.gauge_m = 1.0;
    model.links.resize(1);
    for (const char* name : {"left_track", "right_track"}) {
      RunningGear gear;
      gear.name = name;
      gear.drive_radius_m = 0.25;
      GearDrive drive;
      drive.max_rate_radps = 8.0;
      Lever lever;
      lever.name = name;
      lever.gear = static_cast<int>(model.ground_tools.gears.size());
      model.ground_tools.gears.push_back(gear);
      model.gear_drives.push_back(drive);
      model.levers.push_back(lever);
    }
    state.links.resize(1);
  }
  std::vector<double> Levers(Operator* driver, double t_s) const {
    return driver->Levers({FromSeconds(t_s), model, state, ground});
  }
};

std::unique_ptr<Operator> Read(const std::string& yaml, const Cart& cart) {
  const Config config = Config::FromText(yaml, "operator.yaml");
  const OperatorPlan plan = ReadOperatorPlan(config.root(), cart.model);
  config.Finish();
  return MakeOperator(plan, cart.model, {.seed = 3, .machine = "cart1"});
}

std::string WriteFile(const std::string& name, const std::string& text) {
  const std::string path = OwnFolder() / name;
  std::ofstream(path) << text;
  return path;
}

TEST(LeverReplay, HoldsEachCommandUntilTheNext) {
  const Cart cart;
  const std::string csv = WriteFile(
      "levers.csv", "t_ns,right_track,left_track\n1000000000,0.5,-0.25\n2000000000,1,0\n");
  const auto driver = Read("{type: lever_replay, csv: " + csv + "}", cart);
  EXPECT_THAT(cart.Levers(driver.get(), 0.5), ::testing::ElementsAre(0, 0));
  EXPECT_THAT(cart.Levers(driver.get(), 1.0), ::testing::ElementsAre(-0.25, 0.5));
  EXPECT_THAT(cart.Levers(driver.get(), 1.999), ::testing::ElementsAre(-0.25, 0.5));
  EXPECT_THAT(cart.Levers(driver.get(), 9.0), ::testing::ElementsAre(0, 1));
}

TEST(LeverReplay, RefusesColumnsThatAreNoLevers) {
  const Cart cart;
  const std::string csv = WriteFile("wrong.csv", "t_ns,boom\n0,1\n");
  EXPECT_THAT([&] { Read("{type: lever_replay, csv: " + csv + "}", cart); },
              ThrowsFault(kNoSuchName, "csv"));
}

TEST(LeverReplay, RefusesLeversBeyondTheirTravelWithTheLineThatHoldsThem) {
  const Cart cart;
  const std::string csv =
      WriteFile("far.csv", "t_ns,left_track\n0,0.5\n1000000000,1.0000000001\n2000000000,-12\n");
  EXPECT_THAT([&] { Read("{type: lever_replay, csv: " + csv + "}", cart); },
              ThrowsFault(kOutOfRange, "far.csv:4"));
}

TEST(LeverReplay, TakesALeverThatIsARoundingErrorBeyondItsStop) {
  const Cart cart;
  const std::string csv = WriteFile("near.csv", "t_ns,left_track\n0,1.0000000001\n");
  const auto driver = Read("{type: lever_replay, csv: " + csv + "}", cart);
  EXPECT_EQ(cart.Levers(driver.get(), 1)[0], 1.0);
}

TEST(LeverReplay, RefusesTimesThatRunBackwards) {
  const Cart cart;
  const std::string csv = WriteFile("back.csv", "t_ns,left_track\n5,1\n4,0\n");
  EXPECT_THROW(Read("{type: lever_replay, csv: " + csv + "}", cart), InputError);
}

TEST(TwistReplay, TurnsSpeedAndYawRateIntoLevers) {
  const Cart cart;
  // 1 m/s and 0.8 rad/s with 1 m gauge: 0.6 and 1.4 m/s, of 2 m/s at full lever.
  const std::string csv = WriteFile("twist.csv", "t_s,v,w,x\n0,1,0.8,text\n");
  const auto driver =
      Read("{type: twist_replay, csv: " + csv + ", forward_column: v, yaw_rate_column: w}", cart);
  const auto levers = cart.Levers(driver.get(), 3.0);
  EXPECT_NEAR(levers[0], 0.3, 1e-12);
  EXPECT_NEAR(levers[1], 0.7, 1e-12);
}

TEST(WaypointDriver, DrivesStraightAtAPointAheadAndStopsThere) {
  Cart cart;
  cart.state.links[0].X_WB = MakePose(Vec3(1, 2, 0), 0, 0, 90 * kDeg);
  const auto driver =
      Read("{type: waypoints, waypoints: [{xy_m: [1, 12]}], speed_mps: 1, reached_m: 0.3}", cart);
  EXPECT_THAT(cart.Levers(driver.get(), 0), ::testing::ElementsAre(0, 0));
  EXPECT_NEAR(cart.Levers(driver.get(), 0.1)[0], 0.15, 1e-9);  // 1.5 /s: the rate of a hand
  const auto levers = cart.Levers(driver.get(), 2);
  EXPECT_NEAR(levers[0], 0.5, 1e-9);
  EXPECT_NEAR(levers[1], 0.5, 1e-9);
  cart.state.links[0].X_WB.translation() = Vec3(1, 11.8, 0);
  EXPECT_THAT(cart.Levers(driver.get(), 4), ::testing::ElementsAre(0, 0));
}

TEST(WaypointDriver, TurnsLeftOnTheSpotForAPointBehindItsLeft) {
  Cart cart;
  const auto driver = Read("{type: waypoints, waypoints: [{xy_m: [-5, 5]}]}", cart);
  cart.Levers(driver.get(), 0);
  const auto levers = cart.Levers(driver.get(), 2);
  EXPECT_LT(levers[0], 0);
  EXPECT_NEAR(levers[0], -levers[1], 1e-12);
}

TEST(RandomLevers, UndoEveryPieceOfADriveByItsOpposite) {
  Cart cart;
  const auto driver =
      Read("{type: random_levers, shortest_s: 0.3, longest_s: 0.9, amplitude: 0.8}", cart);
  const double dt_s = 0.001;
  double way[2] = {0, 0}, farthest = 0, largest = 0, travelled = 0;
  for (int step = 0; step < 60000; ++step) {
    const auto levers = cart.Levers(driver.get(), step * dt_s);
    for (int side = 0; side < 2; ++side) {
      way[side] += levers[side] * dt_s;
      travelled += std::abs(levers[side]) * dt_s;
      farthest = std::max(farthest, std::abs(way[side]));
      largest = std::max(largest, std::abs(levers[side]));
    }
  }
  EXPECT_GT(travelled, 20);
  EXPECT_LE(farthest, 0.9 * 0.8 + 0.01 * travelled);  // one piece, plus rounding of the steps
  EXPECT_LE(largest, 0.8);
  EXPECT_GT(largest, 0.7);
}

TEST(RandomLevers, DependOnSeedAndMachineAlone) {
  Cart cart;
  const Config config = Config::FromText("{type: random_levers}", "operator.yaml");
  const OperatorPlan plan = ReadOperatorPlan(config.root(), cart.model);
  const auto at_10_s = [&](std::uint64_t seed, const char* machine) {
    const auto driver = MakeOperator(plan, cart.model, {seed, machine});
    std::vector<double> all;
    for (int step = 0; step < 100; ++step) {
      for (const double u : cart.Levers(driver.get(), 0.1 * step)) all.push_back(u);
    }
    return all;
  };
  EXPECT_EQ(at_10_s(3, "cart1"), at_10_s(3, "cart1"));
  EXPECT_NE(at_10_s(3, "cart1"), at_10_s(4, "cart1"));
  EXPECT_NE(at_10_s(3, "cart1"), at_10_s(3, "cart2"));
}

TEST(RandomLevers, RefusePiecesWithoutAnOrder) {
  const Cart cart;
  EXPECT_THROW(Read("{type: random_levers, shortest_s: 2, longest_s: 1}", cart), InputError);
}

TEST(ReadOperatorPlan, NamesTheJointThatADigCycleLacks) {
  const Cart cart;
  EXPECT_THAT([&] { Read("{type: dig_cycle}", cart); }, ThrowsFault(kNoSuchName, "slew"));
}

MachineModel Excavator() {
  const Config machine = Config::FromFile(DataRoot() / "config/machines/tb235.yaml");
  MachineModel model = ReadMachine(machine.root());
  machine.Finish();
  return model;
}

/// Faults of a dig cycle of the machine, if any.
std::vector<InputFault> DigFaults(const std::string& keys,
                                  const MachineModel& model = Excavator()) {
  const Config config = Config::FromText("{type: dig_cycle, " + keys + "}", "operator.yaml");
  return FaultsIn([&] {
    ReadOperatorPlan(config.root(), model);
    config.Finish();
  });
}

TEST(ReadOperatorPlan, RefusesJointsThatAreNoArmOnASlewingPost) {
  EXPECT_THAT(DigFaults("cycles: 2"), testing::IsEmpty());
  EXPECT_THAT(DigFaults("boom: arm"), HasFault(kInconsistent, "operator.yaml:1:25: boom"));
  EXPECT_THAT(DigFaults("arm: swing"), HasFault(kInconsistent, "arm"));
  EXPECT_THAT(DigFaults("bucket: blade"), HasFault(kInconsistent, "operator.yaml:1:27: bucket"));
  EXPECT_THAT(DigFaults("slew: blade"), HasFault(kInconsistent, "slew"));
}

TEST(ReadOperatorPlan, RefusesADigCycleOfJointsThatNoLeverMoves) {
  MachineModel model = Excavator();
  std::erase_if(model.levers, [](const Lever& lever) { return lever.name == "arm"; });
  EXPECT_THAT(DigFaults("cycles: 2", model), HasFault(kNoSuchName, "type"));
  EXPECT_THAT(DigFaults("arm: arm", model), HasFault(kNoSuchName, "arm"));
  model.levers.clear();
  EXPECT_THAT(DigFaults("cycles: 2", model), HasFault(kNoSuchName, "type"));
}

TEST(ReadOperatorPlan, RefusesMoreDigCyclesThanAnyRunHolds) {
  EXPECT_THAT(DigFaults("patience_s: 0"), HasFault(kOutOfRange, "patience_s"));
  EXPECT_THAT(DigFaults("servo_gain_1ps: 0"), HasFault(kOutOfRange, "servo_gain_1ps"));
  EXPECT_THAT(DigFaults("slew_braking_degps2: -1"), HasFault(kOutOfRange, "slew_braking_degps2"));
  EXPECT_THAT(DigFaults("cycles: 5000000000"), HasFault(kOutOfRange, "cycles"));
}

/// A cut by an operator whose machine stands still and whose bucket's tip nothing moves.
struct HeldCut {
  double ends_s = 0;  ///< when the cut ends
  double boom = 0;    ///< lever 2.2 s after the start
};

/// Tip at radius `r_m` from the slew's axis and height `z_m` above the ground. It enters at 4.2 m,
/// and the cut ends at 2.6 m. At 0.7 m/s that takes 2.3 s; an operator gives up after 3.7 s.
HeldCut CutWithTipHeldAt(double r_m, double z_m) {
  const MachineModel model = Excavator();
  const PlanarArm::Joints joints{model.JointIndex("slew"), model.JointIndex("boom"),
                                 model.JointIndex("arm"), model.JointIndex("bucket")};
  const auto lever_of = [&](int joint) {
    return std::ranges::find(model.levers, joint, &Lever::joint) - model.levers.begin();
  };
  MachineState state;
  state.links.resize(model.links.size());
  state.q_rad.resize(model.joints.size());
  state.qd_radps.resize(model.joints.size());
  const double slew_m = model.joints[joints.slew].X_PJ.translation().z();
  const auto angles = PlanarArm(model, joints, 0).Inverse({r_m, z_m - slew_m, -75 * kDeg});
  state.q_rad[joints.boom] = angles.value().boom_rad;
  state.q_rad[joints.arm] = angles->arm_rad;
  state.q_rad[joints.bucket] = angles->bucket_rad;
  const TerrainSurface ground(TerrainGrid{Vec2(-10, -10), 0.5, 41, 41});

  const double patience_s = 0.02, curl_s = 1.3;
  const Config config = Config::FromText(
      "{type: dig_cycle, dump_azimuth_deg: 60, patience_s: 0.02}", "operator.yaml");
  const auto digger = MakeOperator(ReadOperatorPlan(config.root(), model), model, {});
  HeldCut cut;
  for (int step = 0; step < 1000; ++step) {
    const std::vector<double> levers =
        digger->Levers({FromSeconds(0.01 * step), model, state, ground});
    if (step == 220) cut.boom = levers[lever_of(joints.boom)];
    cut.ends_s = 0.01 * step - curl_s - patience_s;  // it then curls, lifts and swings
    if (levers[lever_of(joints.slew)] != 0) break;
  }
  return cut;
}

TEST(DigCycle, WaitsForATipThatIsHeldBackAndRaisesIt) {
  const HeldCut cut = CutWithTipHeldAt(4.2, 0);
  EXPECT_NEAR(cut.ends_s, 1.6 * 1.6 / 0.7, 0.1);
  EXPECT_GT(cut.boom, 0.3);
}

TEST(DigCycle, GoesOnWhereTheTipIsNearerToTheMachineHoweverHighItIs) {
  for (const double z_m : {-0.4, -0.2, 0.2}) {
    EXPECT_NEAR(CutWithTipHeldAt(2.4, z_m).ends_s, 1.6 / 0.7, 0.1) << z_m;
  }
}

}  // namespace
}  // namespace tera
