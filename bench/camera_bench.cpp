#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "core/stopwatch.h"
#include "dig_site.h"
#include "render/gl/rasterizer.h"
#include "verdict.h"

// Each camera of the quickstart rig during a cut, one rasterizer.

namespace tera::bench {
namespace {

constexpr double kFramesPerSecond = 10;

/// As many as a run takes where nothing else is said.
int Threads() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

enum class Scene { kMoving, kStill };

/// The place of sensor `s` at the k-th frame of a round that begins again and again: a sensor that
/// moves is never twice at the same one.
Pose PlaceOf(std::size_t s, std::size_t k) {
  const std::vector<Instant>& instants = TheDigSite().instants();
  Pose X_WS = instants[k % instants.size()].X_WS[s];
  if (X_WS.matrix() != instants[(k + 1) % instants.size()].X_WS[s].matrix()) {
    X_WS.translation().x() += 1e-6 * static_cast<double>(k);
  }
  return X_WS;
}

/// Exposures of one camera. In a moving scene every frame finds other poses and some ground dug, so
/// that shadows are drawn again; in a still one neither changes.
void Expose(benchmark::State& state, const std::string& name, const CameraModel& model,
            Scene scene) {
  const DigSite& site = TheDigSite();
  static Rasterizer rasterizer(site.model(), {}, Threads());
  const std::size_t s = site.IndexOf(name);
  Camera camera(model, {kFramesPerSecond}, 0, 1, name);
  const auto frame = [&](std::size_t k) {
    const std::size_t at = scene == Scene::kStill ? 0 : k;
    const Instant& instant = site.instants()[at % site.instants().size()];
    benchmark::DoNotOptimize(
        camera.Measure(static_cast<std::int64_t>(k), PlaceOf(s, at), instant.scene, &rasterizer));
  };
  frame(0);  // shaders compiled, ground sent
  const std::int64_t triangles_before = rasterizer.triangles_drawn();
  double wall_s = 0;
  std::size_t k = 0;
  for (auto _ : state) {
    const Stopwatch watch(&wall_s);
    frame(++k);
  }
  const auto frames = static_cast<double>(state.iterations());
  state.counters["frames_ps"] = frames / wall_s;
  state.counters["triangles"] =
      static_cast<double>(rasterizer.triangles_drawn() - triangles_before) / frames;
  ExpectAtLeast({"of real time at 10 Hz", 1, "x"}, frames / wall_s / kFramesPerSecond, &state);
}

const CameraModel& ModelOf(const std::string& camera) {
  return std::get<CameraModel>(TheDigSite().sensors()[TheDigSite().IndexOf(camera)].model);
}

/// As the quickstart has it.
void CameraAsMounted(benchmark::State& state, const std::string& name) {
  Expose(state, name, ModelOf(name), Scene::kMoving);
}

/// Nothing moves: what shadows and changed ground cost is the difference.
void CameraStillScene(benchmark::State& state, const std::string& name) {
  Expose(state, name, ModelOf(name), Scene::kStill);
}

/// Colour alone: neither depth nor labels.
void CameraColourOnly(benchmark::State& state, const std::string& name) {
  CameraModel model = ModelOf(name);
  model.depth = false;
  model.labels.reset();
  Expose(state, name, model, Scene::kMoving);
}

/// Colour, depth, classes, instances, boxes.
void CameraAllOutputs(benchmark::State& state, const std::string& name) {
  CameraModel model = ModelOf(name);
  model.depth = true;
  model.labels = UsualLabels();
  Expose(state, name, model, Scene::kMoving);
}

/// Seconds of all threads of this process.
double Processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Seconds that have passed.
double Wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Milliseconds by `now_s` of each pass of an exposure as mounted, with a wait after each.
void MeasurePasses(benchmark::State& state, const std::string& name, const SceneModel& model,
                   double (*now_s)()) {
  const DigSite& site = TheDigSite();
  Rasterizer rasterizer(model, {}, Threads());
  const std::size_t s = site.IndexOf(name);
  Camera camera(ModelOf(name), {kFramesPerSecond}, 0, 1, name);
  std::map<std::string, double> sum_s;
  double last_s = 0;
  const auto count = [&](const char* pass) {
    const double at_s = now_s();
    sum_s[pass] += at_s - last_s;
    last_s = at_s;
  };
  const auto frame = [&](std::size_t k) {
    const Instant& instant = site.instants()[k % site.instants().size()];
    last_s = now_s();
    benchmark::DoNotOptimize(
        camera.Measure(static_cast<std::int64_t>(k), PlaceOf(s, k), instant.scene, &rasterizer));
    count("noise");
  };
  // Shaders are compiled and grounds of the first round sent before anything counts.
  std::size_t k = 0;
  while (k < site.instants().size()) frame(k++);
  rasterizer.Watch(count);
  sum_s.clear();
  for (auto _ : state) frame(k++);
  for (const auto& [pass, s_of_all] : sum_s) {
    state.counters[pass] = 1e3 * s_of_all / static_cast<double>(state.iterations());
  }
}

void CameraPasses(benchmark::State& state, const std::string& name) {
  MeasurePasses(state, name, TheDigSite().model(), Processor_s);
}

/// The same by the clock on the wall, which a graphics card's work is seen on.
void CameraPassWalls(benchmark::State& state, const std::string& name) {
  MeasurePasses(state, name, TheDigSite().model(), Wall_s);
}

/// By processor time, with wear of every kind on everything that is no ground.
void CameraPassesWorn(benchmark::State& state, const std::string& name) {
  SceneModel model = TheDigSite().model();
  const auto wear = std::make_shared<const NodeWear>(NodeWear{
      .wear = {.dust = 0.5, .mud = 0.5, .scratches = 0.5, .rust = 0.5}, .from_soil_offset_m = 0.3});
  for (SceneNode& node : model.nodes) node.wear = wear;
  MeasurePasses(state, name, model, Processor_s);
}

#define TERA_FOR_EACH_CAMERA(benchmark_of)               \
  BENCHMARK_CAPTURE(benchmark_of, front, "camera_front") \
      ->MeasureProcessCPUTime()                          \
      ->UseRealTime()                                    \
      ->Unit(benchmark::kMillisecond)                    \
      ->Iterations(20);                                  \
  BENCHMARK_CAPTURE(benchmark_of, left, "camera_left")   \
      ->MeasureProcessCPUTime()                          \
      ->UseRealTime()                                    \
      ->Unit(benchmark::kMillisecond)                    \
      ->Iterations(20);                                  \
  BENCHMARK_CAPTURE(benchmark_of, site, "camera_site")   \
      ->MeasureProcessCPUTime()                          \
      ->UseRealTime()                                    \
      ->Unit(benchmark::kMillisecond)                    \
      ->Iterations(20)

TERA_FOR_EACH_CAMERA(CameraAsMounted);
TERA_FOR_EACH_CAMERA(CameraStillScene);
TERA_FOR_EACH_CAMERA(CameraColourOnly);
TERA_FOR_EACH_CAMERA(CameraAllOutputs);
TERA_FOR_EACH_CAMERA(CameraPasses);
TERA_FOR_EACH_CAMERA(CameraPassesWorn);
TERA_FOR_EACH_CAMERA(CameraPassWalls);

}  // namespace
}  // namespace tera::bench
