#include <benchmark/benchmark.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/stopwatch.h"
#include "physics/actuation/actuation.h"
#include "sim/scenario/scenario.h"
#include "verdict.h"

// The chain from levers to joints, as a replay drives it: levers, positions and loads given.

namespace tera::bench {
namespace {

constexpr double kLeast_per_s = 1e6;
constexpr double kReplay_hz = 500;

MachineModel Excavator(const std::vector<Config::Overlay>& effects) {
  const Config config =
      Config::FromFile(DataRoot() / "config/scenarios/quickstart.yaml", {}, effects);
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario.machines.front().placement.model;
}

/// A recording of one machine: what each axis' lever, position and load were.
struct Recorded {
  std::vector<double> levers;
  std::vector<AxisMotion> motions;
};

std::vector<Recorded> Recording(std::size_t axes) {
  std::vector<Recorded> recording(1000);
  for (std::size_t i = 0; i < recording.size(); ++i) {
    for (std::size_t k = 0; k < axes; ++k) {
      const double t_s = static_cast<double>(i) / kReplay_hz, phase = static_cast<double>(k);
      recording[i].levers.push_back(std::sin(3 * t_s + phase));
      recording[i].motions.push_back(
          {0.5 * std::sin(t_s + phase), 0.5 * std::cos(t_s + phase), 4000 * std::cos(2 * t_s)});
    }
  }
  return recording;
}

/// Iterations are steps of the whole machine.
void Replay(benchmark::State& state, const std::vector<Config::Overlay>& effects) {
  const MachineModel model = Excavator(effects);
  const std::size_t axes = model.joints.size() + model.gear_drives.size();
  const std::vector<Recorded> recording = Recording(axes);
  Actuation chain(model, {"excavator1", 1});
  double wall_s = 0, moved_rad = 0;
  {
    const Stopwatch watch(&wall_s);
    std::size_t i = 0;
    for (auto _ : state) {
      const Recorded& now = recording[i++ % recording.size()];
      chain.Step(now.levers, now.motions, 1 / kReplay_hz);
      moved_rad += chain.drives().front().rate_radps / kReplay_hz;
    }
  }
  benchmark::DoNotOptimize(moved_rad);
  const double joint_steps = static_cast<double>(state.iterations()) * static_cast<double>(axes);
  ExpectAtLeast({"joint-steps", kLeast_per_s, "/s"}, joint_steps / wall_s, &state);
}

/// The machine's own effects: eq. (1).
void SlotChain(benchmark::State& state) { Replay(state, {}); }
BENCHMARK(SlotChain)->Iterations(200000)->Unit(benchmark::kNanosecond);

/// All that a hydraulic machine has.
void HydraulicSlotChain(benchmark::State& state) {
  Replay(state, {{DataRoot() / "config/effects/tb235_hydraulic.yaml", "effects"}});
}
BENCHMARK(HydraulicSlotChain)->Iterations(200000)->Unit(benchmark::kNanosecond);

}  // namespace
}  // namespace tera::bench
