#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/units.h"
#include "sim/scenario/load_scenario.h"
#include "sim/simulation.h"

/// Soil removed by the digging operator of the compact excavator.

namespace tera {
namespace {

/// Struck capacity, 0.11 m3, of dirt that has loosened by a tenth of its volume.
constexpr double kStruck_kg = 0.11 * 1474 / 1.1;

/// Mean load of the bucket over a minute, as it swings past 0.9 rad on its way to the dump.
double MeanLoad_kg(const std::vector<std::string>& overrides,
                   const std::vector<std::string>& effects) {
  const LoadedScenario loaded = LoadScenario("config/scenarios/dig_cycle.yaml", overrides, effects);
  Simulation simulation(loaded.scenario);
  const int slew = loaded.scenario.machines[0].placement.model.JointIndex("slew");
  double sum_kg = 0;
  int swings = 0;
  bool dug = false;
  while (simulation.state().t_ns < FromSeconds(loaded.scenario.duration_s)) {
    simulation.Step();
    const MachineState& machine = simulation.state().machines[0];
    dug = dug || machine.q_rad[slew] < 0.3;
    if (!dug || machine.q_rad[slew] < 0.9) continue;
    sum_kg += machine.shovel_load[0].mass_kg;
    ++swings;
    dug = false;
  }
  EXPECT_GE(swings, 3);
  return sum_kg / swings;
}

TEST(CompactDigs, FillTheBucketOfAnIdealMachine) {
  EXPECT_GT(MeanLoad_kg({}, {}), 0.8 * kStruck_kg);
}

TEST(CompactDigs, FillTheBucketThroughDeadBandsOfAQuarterOfTheLever) {
  const std::string band = "{dead_band: {width: 0.25}}";
  EXPECT_GT(MeanLoad_kg({"effects.excavator1={slew: " + band + ", boom: " + band +
                         ", arm: " + band + ", bucket: " + band + "}"},
                        {}),
            0.8 * kStruck_kg);
}

TEST(CompactDigs, FillTheBucketOfAMachineWithHydraulics) {
  EXPECT_GT(MeanLoad_kg({}, {"config/effects/tb235_hydraulic.yaml"}), 0.8 * kStruck_kg);
}

/// Angle between the undercarriage's z and the vertical.
double Lean_rad(const MachineState& machine) {
  return std::acos(std::min(1.0, machine.links[0].X_WB.linear()(2, 2)));
}

TEST(CompactDigs, ATrenchToItsDesignWithoutTippingAndPutTheSoilBeside) {
  const LoadedScenario loaded =
      LoadScenario("examples/tasks/trench.yaml",
                   {"task.trench.to_m=[2.4, 0]", "task.trench.depth_m=0.4", "duration_s=600"});
  const Scenario& scenario = loaded.scenario;
  Simulation simulation(scenario);
  const TaskColumns columns(*scenario.task, scenario.site->surface());
  double most_lean_rad = 0;
  TaskDeviation deviation;
  while (deviation.within < 0.95 && simulation.state().t_ns < FromSeconds(scenario.duration_s)) {
    for (int k = 0; k < 100; ++k) simulation.Step();
    most_lean_rad = std::max(most_lean_rad, Lean_rad(simulation.state().machines[0]));
    deviation = columns.Compare(simulation.ground());
  }
  EXPECT_GE(deviation.within, 0.95);
  EXPECT_LT(deviation.cut_beyond_m3, 0.05 * 2 * 0.6);  // less than the tolerance all over
  EXPECT_LT(most_lean_rad, 15 * kDeg);
  // The slew axis is at 0.15 m, the heap 3.8 m to its left: 0.48 m3 of soil, loosened by a tenth.
  EXPECT_GT(simulation.ground().HeightAt(0.1, 3.8), 0.2);
  // Nothing of it lies on the other side, or on the machine's way back.
  EXPECT_LT(std::abs(simulation.ground().HeightAt(3.4, -1.2)), 0.1);
  EXPECT_LT(std::abs(simulation.ground().HeightAt(-2.5, 0)), 0.1);
}

}  // namespace
}  // namespace tera
