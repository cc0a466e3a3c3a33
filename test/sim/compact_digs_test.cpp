#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tera
