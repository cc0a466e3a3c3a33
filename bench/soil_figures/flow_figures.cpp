#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "soil/flow/avalanche.h"
#include "soil/flow/grains.h"
#include "soil/soil_fixture.h"
#include "soil_figures/figures.h"

namespace tera::bench {
namespace {

using namespace testing_soil;

/// Level ground of one soil that flows, and clods over it.
struct Heap {
  SoilType soil;
  Columns ground;
  Avalanche avalanche;
  Grains grains;

  Heap(const SoilType& type, double cell_m, double half_m, std::uint64_t seed)
      : soil(type),
        ground(LevelColumns(type, cell_m, 2 * static_cast<int>(half_m / cell_m) + 1)),
        avalanche(ground.soils()),
        grains(ground.soils(), seed) {}
  Spoil Loose(double volume_m3) const { return {volume_m3 * LooseDensity_kgpm3(soil), volume_m3}; }
  void Step() {
    grains.Step(kStep_s, &ground);
    avalanche.Flow(kStep_s, &ground, &grains);
  }
  void Rest(double time_s) {
    for (int k = 0; k < time_s / kStep_s; ++k) Step();
  }
};

/// Slope of a straight line through heights between 20 % and 80 % of the top, mean of eight
/// directions.
double Flanks_deg(const Columns& ground) {
  const double top_m = ground.HeightAt(0, 0);
  double mean_deg = 0;
  for (int k = 0; k < 8; ++k) {
    const Vec2 out(std::cos(k * kPi / 4), std::sin(k * kPi / 4));
    double n = 0, r_sum = 0, z_sum = 0, rz_sum = 0, rr_sum = 0;
    for (double r_m = 0; r_m < 3; r_m += 0.01) {
      const double z_m = ground.HeightAt(r_m * out.x(), r_m * out.y());
      if (z_m < 0.2 * top_m || z_m > 0.8 * top_m) continue;
      n += 1, r_sum += r_m, z_sum += z_m, rz_sum += r_m * z_m, rr_sum += r_m * r_m;
    }
    const double slope = (n * rz_sum - r_sum * z_sum) / (n * rr_sum - r_sum * r_sum);
    mean_deg += std::atan(-slope) / kDeg / 8;
  }
  return mean_deg;
}

/// Sand poured on one spot without haste.
double Poured_deg(std::uint64_t seed) {
  Heap heap(Shipped("sand"), 0.05, 2, seed);
  const int mid = heap.ground.nx() / 2, steps = 3000;
  for (int k = 0; k < steps; ++k) {
    for (int n = 0; n < 9; ++n) {
      heap.ground.Deposit(heap.ground.Touch(mid + n % 3 - 1, mid + n / 3 - 1),
                          heap.Loose(0.3 / steps / 9));
    }
    heap.Step();
  }
  heap.Rest(3);
  return Flanks_deg(heap.ground);
}

/// Dirt, 1.3 m3, that falls from 1.5 m within a second, out of a mouth of 1.2 x 0.6 m.
double Dumped_deg(std::uint64_t seed) {
  Heap heap(Shipped("dirt"), 0.05, 3, seed);
  const Stream random(seed, "bench/mouth");
  const int steps = static_cast<int>(1.0 / kStep_s);
  for (int k = 0; k < steps; ++k) {
    const double x_m = 0.6 * (random.Uniform(k, 0) - 0.5);
    SpoilMix spoil;
    spoil.Add(heap.Loose(1.3 / steps));
    heap.grains.Pour(spoil, Vec3(x_m, -0.6, 1.5), Vec3(x_m, 0.6, 1.5), Vec3::Zero(), &heap.ground);
    heap.Step();
  }
  heap.Rest(4);
  return Flanks_deg(heap.ground);
}

/// Radius to which a cylinder of loose sand spreads, 0.5 m in radius and 0.4 m high; mean of 16
/// directions.
double Runout_m() {
  constexpr double kRadius_m = 0.5, kHeight_m = 0.4, kCell_m = 0.05;
  Heap heap(Shipped("sand"), kCell_m, 2, 1);
  Columns& ground = heap.ground;
  for (int j = 0; j < ground.ny(); ++j) {
    for (int i = 0; i < ground.nx(); ++i) {
      const double r_m = std::hypot(ground.x_m(i), ground.y_m(j));
      const double inside = std::clamp((kRadius_m - r_m) / kCell_m + 0.5, 0.0, 1.0);
      ground.Deposit(ground.Touch(i, j), heap.Loose(inside * kHeight_m * ground.area_m2()));
    }
  }
  heap.Rest(4);
  double sum_m = 0;
  for (int k = 0; k < 16; ++k) {
    double end_m = 0;
    for (double r_m = 0; r_m < 1.95; r_m += 0.005) {
      const Vec2 at(r_m * std::cos(k * kPi / 8), r_m * std::sin(k * kPi / 8));
      if (ground.HeightAt(at.x(), at.y()) > 0.004 * kRadius_m) end_m = r_m;
    }
    sum_m += end_m;
  }
  return sum_m / 16;
}

/// Volume that has fallen, after 3 s, from the walls of a pit in clay, 1.4 m deep and as wide.
double Fallen_m3(std::uint64_t seed) {
  const auto soil = MakeGround(
      "size_m: [8, 8]\nsoil: clay\n"
      "pits: [{outline_m: [[-0.7, -0.7], [0.7, -0.7], [0.7, 0.7], [-0.7, 0.7]], depth_m: 1.4}]\n",
      seed);
  for (int k = 0; k < 3 / kStep_s; ++k) soil->Flow(kStep_s);
  double gone_m3 = 0;
  for (double x_m = -3.5; x_m < 3.5; x_m += 0.05) {
    for (double y_m = -3.5; y_m < 3.5; y_m += 0.05) {
      const bool in_pit = std::max(std::abs(x_m), std::abs(y_m)) < 0.75;
      if (!in_pit) gone_m3 -= std::min(0.0, soil->surface().HeightAt(x_m, y_m)) * 0.05 * 0.05;
    }
  }
  return gone_m3;
}

}  // namespace

Figures FlowFigures(std::uint64_t seed) {
  return {{"poured_flank_deg", Poured_deg(seed)},
          {"dumped_flank_deg", Dumped_deg(seed)},
          {"runout_m", Runout_m()},
          {"bank_fallen_m3", Fallen_m3(seed)}};
}

}  // namespace tera::bench
