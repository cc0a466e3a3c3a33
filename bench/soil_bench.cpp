#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>

#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/units.h"
#include "cpu_stopwatch.h"
#include "dig_site.h"
#include "recorded_motion.h"
#include "soil/columns/soil_type.h"
#include "soil/flow/avalanche.h"
#include "soil/flow/grains.h"
#include "verdict.h"

// The soil alone, under a machine that moves as it did in a whole simulation. All in processor time
// on one core.

namespace tera::bench {
namespace {

constexpr int kSteps = 10000;
constexpr double kBucketMean_us = 100, kBucketP95_us = 400, kTracks_us = 120;

// Published step times of other programs on similar tasks, and processor time on two cores of a
// virtual EPYC, a different computer from the present one.
// Vilella's soil simulator: a bucket in 161 x 161 cells of 5 cm, no forces.
constexpr double kVilellaBucket_us = 612;
// Project Chrono's SCM: 4 t on two pads of 1.6 m x 0.3 m, cells of 5 cm, with and without
// bulldozing.
constexpr double kScmBulldozing_us = 1550, kScm_us = 650;

/// A site under the recorded motion of a scenario's first machine.
class Replay {
 public:
  Replay(const std::string& scenario, const std::vector<std::string>& overrides,
         const RecordedMotion& motion)
      : motion_(motion),
        scenario_(LoadWith(scenario, overrides).scenario),
        soil_(MakeSoil(*scenario_.site, scenario_.seed)) {
    machine_ = soil_->AddMachine(scenario_.machines.front().placement.model.ground_tools);
  }
  void Step() {
    const RecordedMotion::Moment& moment = motion_.moments[next_++ % motion_.moments.size()];
    double act_s = 0, flow_s = 0;
    {
      const CpuStopwatch watch(&act_s);
      benchmark::DoNotOptimize(
          soil_->Act(machine_, {&moment.links, moment.gear_rate_radps}, motion_.dt_s));
    }
    {
      const CpuStopwatch watch(&flow_s);
      soil_->Flow(motion_.dt_s);
    }
    act_.Add(act_s);
    flow_.Add(flow_s);
    both_.Add(act_s + flow_s);
  }
  void Count(benchmark::State* state) const {
    state->counters["act_us"] = act_.Mean_us();
    state->counters["flow_us"] = flow_.Mean_us();
  }
  const StepTimes& times() const { return both_; }

 private:
  const RecordedMotion& motion_;
  const Scenario scenario_;
  std::unique_ptr<Soil> soil_;
  int machine_ = 0;
  std::size_t next_ = 0;
  StepTimes act_, flow_, both_;
};

/// The compact excavator digs and dumps: bucket and tracks.
void SoilUnderBucket(benchmark::State& state) {
  const RecordedMotion motion = Record("quickstart", kSteps);
  Replay replay("quickstart", {}, motion);
  for (auto _ : state) replay.Step();
  replay.Count(&state);
  ExpectAtMost(
      {{{"mean", kBucketMean_us, " us"}, replay.times().Mean_us()},
       {{"p95", kBucketP95_us, " us"}, replay.times().P95_us()}},
      fmt::format("peer's bucket alone, other hardware: Vilella {:g} us", kVilellaBucket_us),
      &state);
}
BENCHMARK(SoilUnderBucket)->Iterations(kSteps)->Unit(benchmark::kMicrosecond);

/// It drives over dirt, gravel and, for the last third, sand.
constexpr int kDriveSteps = 16000;
void SoilUnderTracks(benchmark::State& state) {
  const RecordedMotion motion = Record("drive_three_soils", kDriveSteps);
  Replay replay("drive_three_soils", {}, motion);
  for (auto _ : state) replay.Step();
  replay.Count(&state);
  state.counters["p95_us"] = replay.times().P95_us();
  ExpectAtMost({{{"mean", kTracks_us, " us"}, replay.times().Mean_us()}},
               fmt::format("peer, other hardware: Chrono SCM {:g} us, without bulldozing {:g} us",
                           kScmBulldozing_us, kScm_us),
               &state);
}
BENCHMARK(SoilUnderTracks)->Iterations(kDriveSteps)->Unit(benchmark::kMicrosecond);

/// Megabytes of memory that this process has asked for and not given back.
double Held_mb() {
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd) / (1024 * 1024);
}

/// The same motion on a site of 40 m and on one of 500 m, step by step in turn.
void SiteSize(benchmark::State& state, const std::string& scenario) {
  constexpr int kRecorded = 4000;
  const RecordedMotion motion = Record(scenario, kRecorded);
  double before_mb = Held_mb();
  Replay wide(scenario, {"terrain.size_m=[500, 500]"}, motion);
  state.counters["site_mb"] = Held_mb() - before_mb;
  Replay narrow(scenario, {"terrain.size_m=[40, 40]"}, motion);
  double touched_mb = 0;  // what the motion makes of it
  for (auto _ : state) {
    narrow.Step();
    before_mb = Held_mb();
    wide.Step();
    touched_mb += Held_mb() - before_mb;
  }
  state.counters["touched_mb"] = touched_mb;
  state.counters["narrow_us"] = narrow.times().Mean_us();
  state.counters["wide_us"] = wide.times().Mean_us();
  ExpectAtMost({{{"500 m over 40 m", 1.1, ""}, wide.times().Mean_us() / narrow.times().Mean_us()}},
               "", &state);
}

void SiteSizeUnderBucket(benchmark::State& state) { SiteSize(state, "quickstart"); }
BENCHMARK(SiteSizeUnderBucket)->Iterations(4000)->Unit(benchmark::kMicrosecond);

void SiteSizeUnderTracks(benchmark::State& state) { SiteSize(state, "drive_three_soils"); }
BENCHMARK(SiteSizeUnderTracks)->Iterations(4000)->Unit(benchmark::kMicrosecond);

/// Level ground of dirt, 12 m x 12 m of columns of 5 cm.
Columns LevelDirt() {
  constexpr int kColumns = 241;
  const Config config = Config::FromFile(*ShippedSoilFile("dirt"));
  const SoilType soil = ReadSoilType(config.root());
  UndisturbedGround ground;
  ground.grid = {.origin_W_m = Vec2::Constant(-6), .cell_m = 0.05, .nx = kColumns, .ny = kColumns};
  ground.base_cells = TerrainGrid::kTileCells;
  ground.base_height_m.assign(static_cast<std::size_t>(ground.base_nx()) * ground.base_ny(), 0);
  ground.profiles.push_back(
      GroundProfile({{std::numeric_limits<double>::infinity(), 0, static_cast<float>(soil.moisture),
                      soil.bank_density_kgpm3}}));
  return Columns(std::move(ground), {soil});
}

/// Time that bodies without ground need to fall for a step: what no model of clods can be below.
/// Reference load: other processes on the machine slow it as they slow the clods.
class BareFall {
 public:
  explicit BareFall(std::size_t count) : bodies_(count) {}
  void Step(double dt_s) {
    double step_s = 0;
    {
      const CpuStopwatch watch(&step_s);
      for (Body& body : bodies_) {
        body.v_mps.z() -= dt_s * kStandardGravity_mps2;
        body.p_m += dt_s * body.v_mps;
      }
      benchmark::DoNotOptimize(bodies_.data());
    }
    times_.Add(step_s);
  }
  const StepTimes& times() const { return times_; }

 private:
  struct Body {
    Vec3 p_m = Vec3::Zero(), v_mps = Vec3::Zero();
  };
  std::vector<Body> bodies_;
  StepTimes times_;
};

/// As many clods as there may be, poured from 1.5 m on 6 m x 6 m; those that come to rest are
/// poured again.
void GrainsInFlight(benchmark::State& state) {
  constexpr double kStep_s = 0.002, kClod_m3 = 1e-4, kFall_m = 1.5;
  Columns ground = LevelDirt();
  Avalanche avalanche(ground.soils());
  Grains grains(ground.soils(), 7);
  SpoilMix clod;
  clod.Add({kClod_m3 * LooseDensity_kgpm3(ground.soils()[0]), kClod_m3});
  const Stream place(7, "bench/grains");
  std::uint64_t poured = 0;
  const auto pour = [&] {
    const double x_m = 6 * place.Uniform(poured, 1) - 3, y_m = 6 * place.Uniform(poured, 2) - 3;
    const double z_m = kFall_m * (poured < Grains::kMostClods ? place.Uniform(poured, 3) : 1.0);
    const Vec3 p_W(x_m, y_m, ground.HeightAt(x_m, y_m) + z_m);
    grains.Pour(clod, p_W, p_W, Vec3::Zero(), &ground);
    ++poured;
  };
  StepTimes clods, flow, both;
  BareFall bare(Grains::kMostClods);
  for (auto _ : state) {
    while (grains.count() < Grains::kMostClods) pour();
    double clods_s = 0, flow_s = 0;
    {
      const CpuStopwatch watch(&clods_s);
      grains.Step(kStep_s, &ground);
    }
    {
      const CpuStopwatch watch(&flow_s);
      avalanche.Flow(kStep_s, &ground, &grains);
    }
    clods.Add(clods_s);
    flow.Add(flow_s);
    both.Add(clods_s + flow_s);
    bare.Step(kStep_s);
  }
  state.counters["clods_us"] = clods.Mean_us();
  state.counters["flow_us"] = flow.Mean_us();
  state.counters["p95_us"] = both.P95_us();
  state.counters["bare_fall_us"] = bare.times().Mean_us();
  ExpectAtLeast({"real time", 1, " x"}, 1e6 * kStep_s / both.Mean_us(), &state);
}
BENCHMARK(GrainsInFlight)->Iterations(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace tera::bench
