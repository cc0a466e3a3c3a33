#include "sim/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/config/config.h"
#include "core/error.h"
#include "core/units.h"

namespace tera {
namespace {

Scenario Read(const std::string& operator_yaml, const std::vector<std::string>& overrides = {}) {
  const Config config = Config::FromText(R"(
name: test
duration_s: 60
terrain: {size_m: [24, 16], cell_m: 0.1, soil: dirt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [-3, 0], joints_deg: {boom: 45, arm: -110, bucket: -40}}
    operator: )" + operator_yaml + "\n",
                                         "s.yaml", overrides);
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

void StepUntil(Simulation* simulation, double t_s) {
  while (simulation->state().t_ns < FromSeconds(t_s)) simulation->Step();
}

TEST(Simulation, ParkedMachineStaysWhereItStands) {
  Scenario scenario = Read("{type: idle}");
  Simulation simulation(scenario);
  const Pose start = simulation.state().machines[0].links[0].X_WB;
  StepUntil(&simulation, 5.0);
  const Pose end = simulation.state().machines[0].links[0].X_WB;
  EXPECT_LT((end.translation() - start.translation()).norm(), 0.01);
  EXPECT_LT(simulation.state().machines[0].links[0].v_WB_mps.norm(), 0.01);
}

TEST(Simulation, AMachineThatFallsBelowAllGroundEndsTheRun) {
  // A site with a pit of 2 m: the lowest ground is its floor, independent of the machine's place.
  const Config config = Config::FromText(R"(
name: test
duration_s: 60
settle_s: 0
terrain: {size_m: [24, 16], cell_m: 0.1, soil: asphalt, pits: [{outline_m: [[4, 0], [8, 0], [8, 4], [4, 4]], depth_m: 2}]}
machines:
  - name: m1
    machine:
      kind: block
      links: {body: {mass_kg: 500, com_m: [0, 0, 0.4], inertia_kgm2: [100, 100, 100]}}
    start: {xy_m: [-3, 1], yaw_deg: 40}
    operator: {type: idle}
)",
                                         "s.yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  Simulation simulation(scenario);
  std::string fault;
  try {
    StepUntil(&simulation, 3.0);
  } catch (const InputError& error) {
    fault = error.what();
    EXPECT_EQ(error.faults().front().place, "machine m1");
    EXPECT_EQ(error.faults().front().kind, FaultKind::kInconsistent);
  }
  // From 0.4 m to 3 m below the pit's floor: 5.4 m, which a fall takes sqrt(2 h / g) = 1.05 s for.
  EXPECT_NEAR(ToSeconds(simulation.state().t_ns), std::sqrt(2 * 5.4 / 9.80665), 0.02);
  EXPECT_THAT(fault, testing::HasSubstr("machine m1: has fallen below all ground at 1.0"));
  EXPECT_THAT(fault,
              testing::HasSubstr("it touches nothing; give it tracks, wheels or hull_points"));
}

TEST(Simulation, TimeIsTheStepCountOverTheRate) {
  Scenario scenario = Read("{type: idle}", {"physics_rate_hz=300"});
  Simulation simulation(scenario);
  EXPECT_EQ(simulation.state().t_ns, 0);
  for (int k = 0; k < 100; ++k) simulation.Step();
  EXPECT_EQ(simulation.state().t_ns, 333333333);
  EXPECT_EQ(simulation.previous().t_ns, 330000000);
}

TEST(Simulation, WaypointsAreReached) {
  Scenario scenario = Read("{type: waypoints, waypoints: [{xy_m: [4, 2]}], reached_m: 0.4}");
  Simulation simulation(scenario);
  StepUntil(&simulation, 20.0);
  const Vec3 p = simulation.state().machines[0].links[0].X_WB.translation();
  EXPECT_LT((p.head<2>() - Vec2(4, 2)).norm(), 0.6);
}

TEST(Simulation, DigCycleMovesSoilToTheDumpAndLosesNone) {
  Scenario scenario = Read("{type: dig_cycle, dump_azimuth_deg: 90, cycles: 1}");
  Simulation simulation(scenario);
  const TerrainSurface start = simulation.ground();
  double most_kg = 0;
  while (simulation.state().t_ns < FromSeconds(14)) {
    simulation.Step();
    most_kg = std::max(most_kg, simulation.state().machines[0].shovel_load[0].mass_kg);
  }
  EXPECT_GT(most_kg, 30.0);  // a bucket of 0.11 m^3 holds about 150 kg
  EXPECT_LT(simulation.state().machines[0].shovel_load[0].mass_kg, 0.2 * most_kg);
  const MassLedger after = simulation.state().ground().ledger();
  EXPECT_NEAR(after.total_kg() / after.shifted_kg, 0, 1e-9);
  // Soil from ahead of the machine lies to its left. Volumes of change, from the surface.
  double ahead_m3 = 0, left_m3 = 0;
  const TerrainSurface& end = simulation.ground();
  for (int j = 0; j < end.ny; ++j) {
    for (int i = 0; i < end.nx; ++i) {
      const Vec2 p = end.origin_W_m + end.cell_m * Vec2(i, j) - Vec2(-3, 0);
      const double change_m3 =
          (end.height_m(i, j) - start.height_m(i, j)) * end.cell_m * end.cell_m;
      if (p.x() > 1.5 && std::abs(p.y()) < 1.5) ahead_m3 += change_m3;
      if (p.y() > 2.2) left_m3 += change_m3;
    }
  }
  EXPECT_LT(ahead_m3, -0.01);
  EXPECT_GT(left_m3, 0.01);
}

TEST(Simulation, DigCycleAimsAtItsPlacesWhenTheTracksHaveTurnedUnderIt) {
  Scenario scenario = Read("{type: dig_cycle, dump_azimuth_deg: 90}");
  Simulation simulation(scenario);
  const MachineModel& model = scenario.machines[0].placement.model;
  MachineState state = simulation.state().machines[0];
  const Pose X_WB = state.links[0].X_WB;
  const Operators operators = OperatorsOf(scenario);
  Operator& driver = *operators[0];
  const int slew = model.LeverIndex("slew");
  TimeNs t_ns = 0;
  const auto lever_when_turned = [&](double yaw_rad) {
    state.links[0].X_WB = X_WB * MakePose(Vec3::Zero(), RotationFromRpy(0, 0, yaw_rad));
    double lever = 0;
    for (const TimeNs end_ns = t_ns + FromSeconds(0.3); t_ns < end_ns; t_ns += 2000000) {
      lever = driver.Levers({t_ns, model, state, simulation.ground()})[slew];
    }
    return lever;
  };
  EXPECT_NEAR(lever_when_turned(0), 0, 1e-6);
  EXPECT_LT(lever_when_turned(15 * kDeg), -0.3);
  EXPECT_GT(lever_when_turned(-15 * kDeg), 0.3);
}

TEST(Simulation, DigCycleLowersItsBucketAndDumpsItWhenTheSlewStands) {
  // The motor's 3.5 kN m decelerate a full bucket at 22 deg/s2 at most.
  Scenario scenario =
      Read("{type: dig_cycle, dump_azimuth_deg: 90, slew_braking_degps2: 20, cycles: 2}");
  Simulation simulation(scenario);
  const int slew = scenario.machines[0].placement.model.JointIndex("slew");
  double before_kg = 0, fullest_kg = 0;  // out over the heap
  int digs = 0, dumps = 0;
  while (simulation.state().t_ns < FromSeconds(26)) {
    simulation.Step();
    const MachineState& machine = simulation.state().machines[0];
    const double load_kg = machine.shovel_load[0].mass_kg, rate_radps = machine.qd_radps[slew];
    if (before_kg < 5 && load_kg >= 5) {
      ++digs;
      EXPECT_LT(std::abs(rate_radps), 6 * kDeg) << "dig " << digs;
    }
    fullest_kg = machine.q_rad[slew] > 1 ? std::max(fullest_kg, load_kg) : 0;
    if (before_kg > 0.7 * fullest_kg && load_kg <= 0.7 * fullest_kg && fullest_kg > 5) {
      ++dumps;
      EXPECT_LT(std::abs(rate_radps), 11 * kDeg) << "dump " << dumps;
    }
    before_kg = load_kg;
  }
  EXPECT_EQ(digs, 2);
  EXPECT_EQ(dumps, 2);
}

TEST(Simulation, ThreeDigsLeaveATrenchAndAHeapButNoNeedles) {
  for (const std::string soil : {"clay", "sand"}) {
    SCOPED_TRACE(soil);
    const Config config =
        Config::FromFile("config/scenarios/trench.yaml", {"terrain.soil=" + soil});
    Scenario scenario = ReadScenario(config.root());
    config.Finish();
    Simulation simulation(scenario);
    const int slew = scenario.machines[0].placement.model.JointIndex("slew");
    double dumped_m3 = 0, swung_rad = 0;  // outward minus returning load
    while (simulation.state().t_ns < FromSeconds(44)) {
      simulation.Step();
      const MachineState& machine = simulation.state().machines[0];
      constexpr double kHalfWay_rad = 35 * kDeg;
      const bool is_out = machine.q_rad[slew] > kHalfWay_rad, was_out = swung_rad > kHalfWay_rad;
      if (is_out != was_out) dumped_m3 += (is_out ? 1 : -1) * machine.shovel_load[0].volume_m3;
      swung_rad = machine.q_rad[slew];
    }
    const double stuck_m3 = simulation.state().machines[0].shovel_load[0].volume_m3;
    dumped_m3 -= stuck_m3;
    const TerrainSurface& end = simulation.ground();
    float highest_m = -1, lowest_m = 1, needle_m = -1;
    double heap_m3 = 0;  // soil above the former ground, two metres or more to the left
    for (int j = 1; j + 1 < end.ny; ++j) {
      for (int i = 1; i + 1 < end.nx; ++i) {
        const float z_m = end.height_m(i, j);
        const float beside_m = std::max({end.height_m(i - 1, j), end.height_m(i + 1, j),
                                         end.height_m(i, j - 1), end.height_m(i, j + 1)});
        highest_m = std::max(highest_m, z_m);
        lowest_m = std::min(lowest_m, z_m);
        needle_m = std::max(needle_m, z_m - beside_m);
        if (end.y_m(j) > 2) heap_m3 += std::max(z_m, 0.0f) * end.cell_m * end.cell_m;
      }
    }
    // Three buckets of 0.11 m^3, swollen by up to 1.4, make a cone at 35 deg of 0.60 m.
    EXPECT_LT(highest_m, 0.6);
    EXPECT_GT(highest_m, 0.3);
    // All soil that left the bucket lies there; 2.5 cm of clay adhere to 1.02 m^2 of steel.
    EXPECT_NEAR(heap_m3 / dumped_m3, 1, 0.05);
    EXPECT_NEAR(stuck_m3, soil == "clay" ? 0.0254 : 0, 0.001);
    EXPECT_GT(heap_m3, 3 * (soil == "clay" ? 0.07 - 0.0254 : 0.08));
    EXPECT_LT(heap_m3, 3 * 0.11 * 1.5);
    EXPECT_LT(lowest_m, -0.25);
    EXPECT_LT(needle_m, 0.06);
    const MassLedger ledger = simulation.state().ground().ledger();
    EXPECT_NEAR(ledger.total_kg() / ledger.shifted_kg, 0, 1e-9);
  }
}

TEST(Simulation, DigCycleFillsItsBucketThroughDeadBandsAndDelay) {
  std::vector<std::string> overrides;
  for (const char* joint : {"slew", "boom", "arm", "bucket"}) {
    overrides.push_back(std::string("effects.excavator1.") + joint +
                        "={dead_band: {width: 0.12}, rate_gain: {gain: 1.136}, command_delay: "
                        "{delay_s: 0.12}}");
  }
  Scenario scenario = Read("{type: dig_cycle, dump_azimuth_deg: 90, cycles: 1}", overrides);
  Simulation simulation(scenario);
  double most_kg = 0;
  while (simulation.state().t_ns < FromSeconds(16)) {
    simulation.Step();
    most_kg = std::max(most_kg, simulation.state().machines[0].shovel_load[0].mass_kg);
  }
  EXPECT_GT(most_kg, 75.0);  // half of the bucket's capacity
  EXPECT_LT(simulation.state().machines[0].shovel_load[0].mass_kg, 0.2 * most_kg);
}

TEST(Simulation, DigCycleFeelsItsWayThroughDeadBands) {
  // The full rate falls by the dead band, unknown to the operator.
  const auto most_kg = [](const std::string& width) {
    std::vector<std::string> overrides;
    for (const char* joint : {"slew", "boom", "arm", "bucket"}) {
      overrides.push_back(std::string("effects.excavator1.") + joint + ".dead_band.width=" + width);
    }
    Scenario scenario = Read("{type: dig_cycle, dump_azimuth_deg: 90, cycles: 1}", overrides);
    Simulation simulation(scenario);
    double most_kg = 0;
    while (simulation.state().t_ns < FromSeconds(18)) {
      simulation.Step();
      most_kg = std::max(most_kg, simulation.state().machines[0].shovel_load[0].mass_kg);
    }
    EXPECT_LT(simulation.state().machines[0].shovel_load[0].mass_kg, 0.2 * most_kg) << width;
    return most_kg;
  };
  const double ideal_kg = most_kg("0");
  EXPECT_GT(most_kg("0.1"), 0.8 * ideal_kg);
  EXPECT_GT(most_kg("0.25"), 0.8 * ideal_kg);
}

TEST(Simulation, TwoMachinesHaveTheirOwnLeversAndJoints) {
  const Config config = Config::FromText(R"(
name: two
duration_s: 5
terrain: {size_m: [30, 30], cell_m: 0.2, soil: gravel}
machines:
  - {name: a, machine: tera:config/machines/tb235.yaml, start: {xy_m: [-7, 0]}, operator: {type: idle}}
  - {name: b, machine: tera:config/machines/tb235.yaml, start: {xy_m: [7, 0]}, operator: {type: dig_cycle}}
)",
                                         "two.yaml");
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  Simulation simulation(scenario);
  const int boom = scenario.machines[0].placement.model.JointIndex("boom");
  const double start_rad = simulation.state().machines[0].q_rad[boom];
  StepUntil(&simulation, 2.0);
  EXPECT_NEAR(simulation.state().machines[0].q_rad[boom], start_rad, 0.01);
  EXPECT_GT(std::abs(simulation.state().machines[1].q_rad[boom] - start_rad), 0.05);
}

}  // namespace
}  // namespace tera
