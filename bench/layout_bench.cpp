#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "core/stopwatch.h"
#include "dataset/files/checked_file.h"
#include "dig_site.h"
#include "layout/evaluate.h"
#include "scratch_folder.h"
#include "verdict.h"

// Cost of the views of a layout over the quickstart.

namespace tera::bench {
namespace {

constexpr int kPlaces = 20000;
constexpr double kEye_m = 3.0;  ///< above the machine's root, over its cab

/// Lines of sight from above the machine to places around it, and the same as rays for Embree
/// alone.
class Lines {
 public:
  Lines()
      : scenario_(Load("quickstart").scenario),
        assembly_(scenario_),
        sighting_(scenario_, assembly_, 1),
        bare_(assembly_.model()) {
    const Simulation simulation(scenario_);
    sighting_.Show(simulation.state(), simulation.ground());
    bare_.Update({assembly_.BodyPoses(simulation.state())}, simulation.ground(),
                 assembly_.ShapesOf(simulation.state()));
    const Pose X_WH = Levelled(simulation.state().machines[0].links[0].X_WB);
    const Zone around{.name = "around", .shape = ZoneCylinder{12, 2}};
    for (const Vec3& p_m : PointsIn(around, kPlaces, 1)) {
      lines_.push_back({X_WH * Vec3(0, 0, kEye_m), X_WH * p_m});
      const Vec3 way_m = lines_.back().to_W_m - lines_.back().from_W_m;
      rays_.push_back({.origin_W_m = lines_.back().from_W_m.cast<float>(),
                       .direction_W = way_m.normalized().cast<float>(),
                       .max_range_m = static_cast<float>(way_m.norm() - Sighting::kTouch_m)});
    }
    ranges_m_.resize(rays_.size());
  }

  void Try() const { benchmark::DoNotOptimize(sighting_.Try(lines_)); }
  void TraceBareSingly() { bare_.TraceBareSingly(rays_, ranges_m_); }
  void TraceBareInPackets() { bare_.TraceBareInPackets(rays_, ranges_m_); }
  double count() const { return static_cast<double>(lines_.size()); }

 private:
  const Scenario scenario_;
  const SceneAssembly assembly_;
  Sighting sighting_;
  RayScene bare_;
  std::vector<Sighting::Line> lines_;
  std::vector<Ray> rays_;
  std::vector<float> ranges_m_;
};

/// Lines of sight on one thread beside Embree alone for the same rays, taken in turn. The target is
/// held against bare Embree ray by ray.
void SightBesideBareEmbree(benchmark::State& state) {
  Lines lines;
  double sight_s = 0, singly_s = 0, in_packets_s = 0;
  for (auto _ : state) {
    {
      const Stopwatch watch(&singly_s);
      lines.TraceBareSingly();
    }
    {
      const Stopwatch watch(&in_packets_s);
      lines.TraceBareInPackets();
    }
    const Stopwatch watch(&sight_s);
    lines.Try();
  }
  const double rays = lines.count() * static_cast<double>(state.iterations());
  state.counters["sight_rays_ps"] = rays / sight_s;
  state.counters["single_rays_ps"] = rays / singly_s;
  const std::string what =
      fmt::format("of bare Embree in packets {:.2f}, ray by ray", in_packets_s / sight_s);
  ExpectAtLeast({what, 0.8, ""}, singly_s / sight_s, &state);
}
BENCHMARK(SightBesideBareEmbree)->Unit(benchmark::kMillisecond)->MinTime(3);

/// Six sensors that see: the quickstart's three, two more cameras and a lidar behind.
constexpr char kSixSensors[] = R"(sensors:
  - {name: camera_front, preset: "tera:config/sensors/realsense_d435i.yaml", link: upper, xyz_m: [0.78, 0.35, 1.82], rpy_deg: [0, 28, 0]}
  - {name: camera_left, preset: "tera:config/sensors/rgb_640.yaml", link: upper, xyz_m: [0.15, 0.86, 1.75], rpy_deg: [0, 25, 90]}
  - {name: camera_right, preset: "tera:config/sensors/rgb_640.yaml", link: upper, xyz_m: [0.15, -0.86, 1.75], rpy_deg: [0, 25, -90]}
  - {name: camera_rear, preset: "tera:config/sensors/rgb_640.yaml", link: upper, xyz_m: [-1.25, 0, 1.75], rpy_deg: [0, 25, 180]}
  - {name: lidar_roof, preset: "tera:config/sensors/os1_64.yaml", link: upper, xyz_m: [0.05, 0.35, 2.10], rpy_deg: [0, 10, 0]}
  - {name: lidar_rear, preset: "tera:config/sensors/vlp16.yaml", link: upper, xyz_m: [-1.2, 0, 1.6], rpy_deg: [0, 15, 180]}
)";

/// Everything that is asked of one rig of six sensors, over the quickstart's 20 s at 5 Hz, physics
/// and soil included, on two threads.
void EvaluateSixSensors(benchmark::State& state) {
  const ScratchFolder scratch("layout");
  WriteWholeFile(scratch.path() / "six.yaml", kSixSensors);
  const LayoutStudy study = LoadStudy({});
  double wall_s = 0;
  for (auto _ : state) {
    const Stopwatch watch(&wall_s);
    const Cycle cycle(DataRoot() / "config/scenarios/quickstart.yaml", {});
    const Layout layout = LoadLayout(scratch.path() / "six.yaml", cycle, 0);
    benchmark::DoNotOptimize(Evaluate(cycle, study, {layout}, {.threads = 2}));
  }
  ExpectAtMost({"six sensors over 20 s", 30, "s"}, wall_s / static_cast<double>(state.iterations()),
               &state);
}
BENCHMARK(EvaluateSixSensors)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1);

}  // namespace
}  // namespace tera::bench
