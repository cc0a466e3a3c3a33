#include <benchmark/benchmark.h>

#include <algorithm>
#include <thread>

#include "dig_site.h"
#include "scratch_folder.h"
#include "sim/run/generate.h"
#include "verdict.h"

// Shipped scenarios from start to finished dataset, with all their sensors or some. Figures are
// factors of real time: simulated seconds over seconds taken.

namespace tera::bench {
namespace {

template <typename Model>
bool Is(const SensorDescription& sensor) {
  return std::holds_alternative<Model>(sensor.model);
}

using Keep = std::function<bool(const SensorDescription&)>;

GenerateReport RunShipped(const std::string& scenario, const Keep& keep) {
  const ScratchFolder folder("run");
  ShippedScenario loaded = Load(scenario, keep);
  GenerateOptions options;
  options.out = folder.path() / "out";
  options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return Generate(loaded.scenario, loaded.resolved_yaml, options);
}

GenerateReport RunQuickstart(const Keep& keep) { return RunShipped("quickstart", keep); }

void Report(const GenerateReport& report, benchmark::State* state) {
  const auto factor = [&](const char* name, double wall_s) {
    if (wall_s > 0) state->counters[name] = report.simulated_s / wall_s;
  };
  factor("x_physics", report.physics_s);
  factor("x_soil", report.soil_s);
  factor("x_cameras", report.camera_s);
  factor("x_waiting_for_cameras", report.camera_wait_s);
  factor("x_lidars", report.lidar_s);
  factor("x_other",
         report.wall_s - report.physics_s - report.soil_s - report.camera_wait_s - report.lidar_s);
  factor("x_whole", report.wall_s);
}

void RunInertial(benchmark::State& state) {
  GenerateReport report;
  for (auto _ : state) {
    report = RunQuickstart(
        [](const SensorDescription& s) { return !Is<CameraModel>(s) && !Is<LidarModel>(s); });
  }
  Report(report, &state);
  ExpectAtLeast({"of real time", 10, "x"}, report.simulated_s / report.wall_s, &state);
}

void RunLidar(benchmark::State& state) {
  GenerateReport report;
  for (auto _ : state) {
    report = RunQuickstart([](const SensorDescription& s) { return !Is<CameraModel>(s); });
  }
  Report(report, &state);
  ExpectAtLeast({"of real time", 3, "x"}, report.simulated_s / report.wall_s, &state);
}

void RunDepthCamera(benchmark::State& state) {
  GenerateReport report;
  for (auto _ : state) {
    report = RunQuickstart([](const SensorDescription& s) { return s.name == "camera_front"; });
  }
  Report(report, &state);
  ExpectAtLeast({"of real time", 1, "x"}, report.simulated_s / report.wall_s, &state);
}

void RunWhole(benchmark::State& state) {
  GenerateReport report;
  for (auto _ : state) {
    report = RunQuickstart([](const SensorDescription&) { return true; });
  }
  Report(report, &state);
}

/// Two compact excavators, one of 20 t and a dozer at once, without cameras.
void RunFourMachines(benchmark::State& state) {
  GenerateReport report;
  for (auto _ : state) {
    report = RunShipped("four_machines", [](const SensorDescription&) { return true; });
  }
  Report(report, &state);
  ExpectAtLeast({"of real time", 3, "x"}, report.simulated_s / report.wall_s, &state);
}

BENCHMARK(RunInertial)
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kSecond);
BENCHMARK(RunLidar)->Iterations(1)->MeasureProcessCPUTime()->UseRealTime()->Unit(
    benchmark::kSecond);
BENCHMARK(RunDepthCamera)
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kSecond);
BENCHMARK(RunWhole)->Iterations(1)->MeasureProcessCPUTime()->UseRealTime()->Unit(
    benchmark::kSecond);

BENCHMARK(RunFourMachines)
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace tera::bench
