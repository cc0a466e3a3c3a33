#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/config/config.h"
#include "core/stopwatch.h"
#include "dig_site.h"
#include "sensors/sensor.h"
#include "verdict.h"

// The quickstart's lidar (64 beams, 1024 columns, 10 Hz) during a cut.

namespace tera::bench {
namespace {

constexpr double kScansPerSecond = 10;

/// One revolution between two instants of the dig site: the ray scene over it, the sensor, and the
/// sensor's rays for Embree alone.
class Revolution {
 public:
  Revolution() : Revolution(std::get<LidarModel>(RoofLidar().model)) {}
  explicit Revolution(const LidarModel& model)
      : site_(TheDigSite()),
        model_(model),
        lidar_(model_, Clock(), 0, 1, "bench"),
        scene_(site_.model()) {
    const std::size_t s = site_.IndexOf("lidar_roof");
    for (const Instant* instant : {&From(), &To()}) {
      track_.Append(instant->scene.t_ns, instant->X_WS[s]);
    }
    UpdateScene();
    for (int column = 0; column < model_.columns; ++column) AimColumn(column);
    ranges_m_.resize(rays_.size());
  }

  void UpdateScene() {
    constexpr int kPoses = Lidar::kScenePoses;
    std::vector<std::vector<Pose>> poses(kPoses);
    for (int k = 0; k < kPoses; ++k) {
      for (std::size_t b = 0; b < From().scene.X_WB.size(); ++b) {
        poses[k].push_back(Interpolate(From().scene.X_WB[b], To().scene.X_WB[b],
                                       static_cast<double>(k) / (kPoses - 1)));
      }
    }
    scene_.Update(poses, To().ground, To().scene.shapes);
  }
  LidarScan Measure(int threads, const SensedAir& air = {}) const {
    return lidar_.Measure(0, track_, scene_, threads, air);
  }
  void TraceBareSingly() { scene_.TraceBareSingly(rays_, ranges_m_); }
  void TraceBareInPackets() { scene_.TraceBareInPackets(rays_, ranges_m_); }
  double rays() const { return static_cast<double>(rays_.size()); }

 private:
  static const SensorDescription& RoofLidar() {
    return TheDigSite().sensors()[TheDigSite().IndexOf("lidar_roof")];
  }
  const Instant& From() const { return site_.instants()[4]; }
  const Instant& To() const { return site_.instants()[5]; }
  SampleClock Clock() const { return {kScansPerSecond, From().scene.t_ns}; }

  void AimColumn(int column) {
    const double part = static_cast<double>(column) / model_.columns;
    const TimeNs span_ns = To().scene.t_ns - From().scene.t_ns;
    const Pose X_WS = track_.At(From().scene.t_ns + FromSeconds(part * ToSeconds(span_ns)));
    const double spin = (model_.clockwise ? -2 : 2) * std::numbers::pi * part;
    for (std::size_t b = 0; b < model_.elevation_rad.size(); ++b) {
      const double up = model_.elevation_rad[b];
      const double turn = std::numbers::pi + spin + model_.azimuth_offset_rad[b];
      const Vec3 d_S(std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up));
      rays_.push_back({X_WS.translation().cast<float>(), (X_WS.linear() * d_S).cast<float>(),
                       static_cast<float>(model_.max_range_m), static_cast<float>(part)});
    }
  }

  const DigSite& site_;
  LidarModel model_;
  Lidar lidar_;
  RayScene scene_;
  PoseTrack track_;
  std::vector<Ray> rays_;
  std::vector<float> ranges_m_;
};

/// All that the sensor does on one thread, beside Embree alone for the same rays on one thread: ray
/// by ray, and in packets of eight, as the sensor itself asks. Taken in turn, so that whatever else
/// the machine does strikes all three. The label says both ratios; the target is held against bare
/// Embree ray by ray.
void LidarBesideBareEmbree(benchmark::State& state) {
  Revolution revolution;
  double sensor_s = 0, singly_s = 0, in_packets_s = 0;
  for (auto _ : state) {
    {
      const Stopwatch watch(&singly_s);
      revolution.TraceBareSingly();
    }
    {
      const Stopwatch watch(&in_packets_s);
      revolution.TraceBareInPackets();
    }
    const Stopwatch watch(&sensor_s);
    benchmark::DoNotOptimize(revolution.Measure(1));
  }
  const double rays = revolution.rays() * static_cast<double>(state.iterations());
  state.counters["sensor_rays_ps"] = rays / sensor_s;
  state.counters["single_rays_ps"] = rays / singly_s;
  state.counters["packet_rays_ps"] = rays / in_packets_s;
  const std::string what =
      fmt::format("of bare Embree in packets {:.2f}, ray by ray", in_packets_s / sensor_s);
  ExpectAtLeast({what, 0.8, ""}, singly_s / sensor_s, &state);
}
BENCHMARK(LidarBesideBareEmbree)->Unit(benchmark::kMillisecond)->MinTime(3);

/// A whole scan: bodies posed, changed ground rebuilt, rays traced on `threads` threads.
void LidarScanWithUpdate(benchmark::State& state) {
  Revolution revolution;
  double wall_s = 0;
  for (auto _ : state) {
    const Stopwatch watch(&wall_s);
    revolution.UpdateScene();
    benchmark::DoNotOptimize(revolution.Measure(static_cast<int>(state.range(0))));
  }
  const auto scans = static_cast<double>(state.iterations());
  state.counters["rays_ps"] = revolution.rays() * scans / wall_s;
  ExpectAtLeast({"lidar alone, of real time", 3, "x"}, scans / wall_s / kScansPerSecond, &state);
}
BENCHMARK(LidarScanWithUpdate)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(2);

LidarModel PresetLidar(const std::string& name) {
  const Config config = Config::FromText(
      "s: {name: l, link: u, preset: 'tera:config/sensors/" + name + ".yaml'}", "bench");
  const SensorDescription sensor = ReadSensor(config.root().Map("s"));
  config.Finish();
  return std::get<LidarModel>(sensor.model);
}

/// A preset's scan of the dig site in weather: points, and those that the air returned, over the
/// pulses.
void LidarInAir(benchmark::State& state, const std::string& preset, const SensedAir& air) {
  const Revolution revolution(PresetLidar(preset));
  LidarScan scan;
  for (auto _ : state) scan = revolution.Measure(1, air);
  const auto of_air = std::count_if(
      scan.points.begin(), scan.points.end(),
      [](const LidarPoint& p) { return p.label == static_cast<int>(SemanticClass::kRain); });
  state.counters["points_percent"] =
      100 * static_cast<double>(scan.points.size()) / revolution.rays();
  state.counters["of_air_percent"] = 100 * static_cast<double>(of_air) / revolution.rays();
  state.counters["pulses_ps"] = benchmark::Counter(
      revolution.rays() * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

const bool kLidarsInAir = [] {
  const std::vector<std::pair<std::string, SensedAir>> airs = {{"clear", {}},
                                                               {"rain_2", {.rain_mmph = 2}},
                                                               {"rain_10", {.rain_mmph = 10}},
                                                               {"rain_25", {.rain_mmph = 25}},
                                                               {"snowfall_1", {.snowfall_mmph = 1}},
                                                               {"fog_2000", {.visibility_m = 2000}},
                                                               {"fog_500", {.visibility_m = 500}},
                                                               {"fog_150", {.visibility_m = 150}},
                                                               {"fog_50", {.visibility_m = 50}},
                                                               {"fog_15", {.visibility_m = 15}}};
  for (const std::string preset :
       {"os1_64", "os1_128", "vlp16", "os1_32", "os0_128", "vlp32c", "hdl64e"}) {
    for (const auto& [name, air] : airs) {
      benchmark::RegisterBenchmark(("LidarInAir/" + preset + "/" + name).c_str(), LidarInAir,
                                   preset, air)
          ->Unit(benchmark::kMillisecond)
          ->Iterations(1);
    }
  }
  return true;
}();

}  // namespace
}  // namespace tera::bench
