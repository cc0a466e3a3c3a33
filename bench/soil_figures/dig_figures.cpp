#include <algorithm>

#include "core/time.h"
#include "dig_site.h"
#include "soil_figures/figures.h"

namespace tera::bench {
namespace {

/// Soil that a bucket has brought up: the most that it held between being empty and empty again.
class Buckets {
 public:
  void Add(double load_kg) {
    most_kg_ = std::max(most_kg_, load_kg);
    if (most_kg_ > kFull_kg && load_kg < kEmpty_kg) sum_kg_ += most_kg_, most_kg_ = 0;
  }
  double sum_kg() const { return sum_kg_ + (most_kg_ > kFull_kg ? most_kg_ : 0); }

 private:
  static constexpr double kFull_kg = 40, kEmpty_kg = 10;
  double most_kg_ = 0, sum_kg_ = 0;
};

/// Lowest ground of the trench, highest of the heap beside it, from the ground at the start.
struct Reach {
  double trench_m = 0, heap_m = 0;
  explicit Reach(const TerrainSurface& ground) {
    for (double x_m = -3; x_m < 6; x_m += 0.05) {
      for (double y_m = -1; y_m < 6; y_m += 0.05) {
        const double z_m = ground.HeightAt(x_m, y_m);
        if (x_m > 2.5 && y_m < 1) trench_m = std::max(trench_m, -z_m);
        if (y_m > 2) heap_m = std::max(heap_m, z_m);
      }
    }
  }
};

}  // namespace

Figures DigFigures(std::uint64_t seed) {
  ShippedScenario trench = LoadWith("trench", {"duration_s=40"});
  Scenario& scenario = trench.scenario;
  scenario.seed = seed;
  scenario.machines.resize(1);  // without the mast of the camera
  scenario.machines[0].sensors.clear();
  Simulation simulation(scenario);
  Buckets buckets;
  while (ToSeconds(simulation.state().t_ns) < scenario.duration_s) {
    simulation.Step();
    buckets.Add(simulation.state().machines[0].shovel_load[0].mass_kg);
  }
  const Reach reach(simulation.ground());
  return {{"three_digs_depth_m", reach.trench_m},
          {"three_digs_load_kg", buckets.sum_kg()},
          {"three_digs_heap_m", reach.heap_m}};
}

}  // namespace tera::bench
