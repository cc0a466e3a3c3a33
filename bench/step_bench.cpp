#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>

#include "core/stopwatch.h"
#include "core/units.h"
#include "dig_site.h"
#include "sim/simulation.h"
#include "verdict.h"

// One step of the simulation, 500 of them a simulated second.

namespace tera::bench {
namespace {

/// Steps `name` from its start; iterations are steps.
void Step(benchmark::State& state, const std::string& name, double limit_us) {
  ShippedScenario loaded = Load(name);
  Simulation simulation(&loaded.scenario);
  const double physics_before_s = simulation.physics_wall_s();
  const double soil_before_s = simulation.soil_wall_s();
  StepTimes whole, soil;
  for (auto _ : state) {
    const double soil_s = simulation.soil_wall_s();
    double step_s = 0;
    {
      const Stopwatch watch(&step_s);
      simulation.Step();
    }
    whole.Add(step_s);
    soil.Add(simulation.soil_wall_s() - soil_s);
  }
  const auto each_us = [&](double sum_s) {
    return 1e6 * sum_s / static_cast<double>(state.iterations());
  };
  state.counters["p95_us"] = whole.P95_us();
  state.counters["physics_us"] = each_us(simulation.physics_wall_s() - physics_before_s);
  state.counters["soil_us"] = each_us(simulation.soil_wall_s() - soil_before_s);
  state.counters["soil_p95_us"] = soil.P95_us();
  ExpectAtMost({"soil mean", limit_us, " us"}, soil.Mean_us(), &state);
}

/// Physics and soil for 20 s: two dig cycles and the beginning of a third.
void DigStep(benchmark::State& state) { Step(state, "quickstart", 200); }
BENCHMARK(DigStep)->Iterations(10000)->Unit(benchmark::kMicrosecond);

/// Physics and soil, tracks over dirt, gravel and sand.
void DriveStep(benchmark::State& state) { Step(state, "drive_three_soils", 300); }
BENCHMARK(DriveStep)->Iterations(10000)->Unit(benchmark::kMicrosecond);

/// A spring and a damper that hold a machine up where the ground would.
Wrench Hold(const BodyState& body, const Pose& X_WB, double mass_kg) {
  constexpr double kStiffness_1ps2 = 400, kDamping_1ps = 30;  // per kilogram, and square metre
  const Eigen::AngleAxisd turn(X_WB.linear() * body.X_WB.linear().transpose());
  Wrench wrench;
  wrench.force_W_n = mass_kg * (Vec3(0, 0, kStandardGravity_mps2) +
                                kStiffness_1ps2 * (X_WB.translation() - body.X_WB.translation()) -
                                kDamping_1ps * body.v_WB_mps);
  wrench.torque_W_nm =
      mass_kg * (kStiffness_1ps2 * turn.angle() * turn.axis() - kDamping_1ps * body.w_WB_radps);
  return wrench;
}

/// The whole excavator, all levers swaying, held up by a spring instead of soil.
void PhysicsStep(benchmark::State& state) {
  const ShippedScenario loaded = Load("quickstart");
  const MachinePlacement& excavator = loaded.scenario.machines.front().placement;
  PhysicsWorld world({excavator}, {}, kStandardGravity_mps2);
  const MachineModel& model = excavator.model;
  const Pose X_WB = world.machines()[0].links[0].X_WB;
  const double dt_s = 1.0 / loaded.scenario.physics_rate_hz, mass_kg = model.TotalMass_kg();
  MachineInput input;
  input.soil.link_wrench.resize(model.links.size());
  input.soil.gear_traction_n.assign(model.ground_tools.gears.size(), 0.0);
  input.soil.shovel_load.resize(model.ground_tools.shovels.size());
  input.soil.gear_sinkage_m = input.soil.gear_slip = input.soil.gear_traction_n;
  std::int64_t steps = 0;
  for (auto _ : state) {
    const double t_s = static_cast<double>(steps++) * dt_s;
    input.soil.link_wrench[0] = Hold(world.machines()[0].links[0], X_WB, mass_kg);
    input.levers.assign(model.levers.size(), 0.6 * std::sin(t_s));
    world.Step({input}, {}, dt_s);
  }
  state.counters["z_m"] = world.machines()[0].links[0].X_WB.translation().z();
}
BENCHMARK(PhysicsStep)->Iterations(10000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace tera::bench
