#include <benchmark/benchmark.h>

#include "cpu_stopwatch.h"
#include "dig_site.h"
#include "mujoco_renderer.h"
#include "render/gl/rasterizer.h"
#include "verdict.h"

// Pictures of the quickstart's front camera beside those of MuJoCo's own renderer, in turn.

namespace tera::bench {
namespace {

/// TERA gives colour, depth and all labels that a rasterizer can give; MuJoCo colour and depth, and
/// with `segments` what it has for labels, in a second picture. By processor time.
void PictureBesideMujoco(benchmark::State& state, MujocoRenderer::Output output) {
  const DigSite& site = TheDigSite();
  const std::size_t s = site.IndexOf("camera_front");
  CameraIntrinsics lens = std::get<CameraModel>(site.sensors()[s].model).intrinsics;
  static Rasterizer rasterizer(site.model(), {});
  static MujocoRenderer mujoco(site.model(), site.instants().front().ground, lens.width_px,
                               lens.height_px);
  LabelSet labels = UsualLabels();
  labels.set(kNormalChannel);
  double tera_s = 0, mujoco_s = 0;
  std::int64_t triangles_before = 0;
  std::size_t k = 0;
  const auto pictures = [&] {
    const Instant& instant = site.instants()[k++ % site.instants().size()];
    Pose X_WC = instant.X_WS[s] * OpticalInSensor();
    X_WC.translation().x() += 1e-6 * static_cast<double>(k);  // never twice the same
    {
      const CpuStopwatch watch(&tera_s);
      benchmark::DoNotOptimize(rasterizer.Render(lens, X_WC, instant.scene, labels));
    }
    const CpuStopwatch watch(&mujoco_s);
    mujoco.Render(lens, X_WC, instant.scene, output);
  };
  while (k < 2) pictures();  // shaders compiled, ground sent
  tera_s = mujoco_s = 0;
  triangles_before = rasterizer.triangles_drawn();
  for (auto _ : state) pictures();
  const auto frames = static_cast<double>(state.iterations());
  state.counters["tera_cpu_ms"] = 1e3 * tera_s / frames;
  state.counters["mujoco_cpu_ms"] = 1e3 * mujoco_s / frames;
  state.counters["tera_triangles"] =
      static_cast<double>(rasterizer.triangles_drawn() - triangles_before) / frames;
  state.counters["mujoco_triangles"] = static_cast<double>(mujoco.triangles());
  ExpectAtLeast({"of MuJoCo's pictures in the same processor time", 3, "x"}, mujoco_s / tera_s,
                &state);
}

BENCHMARK_CAPTURE(PictureBesideMujoco, colour_and_depth, MujocoRenderer::Output::kColourAndDepth)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(20);
BENCHMARK_CAPTURE(PictureBesideMujoco, and_segments, MujocoRenderer::Output::kAndSegments)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(20);

}  // namespace
}  // namespace tera::bench
