#include "soil/tool/heap_surface.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kCoarse = 3;    ///< cell size of the trial grid over that of the final grid
constexpr int kTurns = 6;        ///< bisections for the turn of the heap
constexpr int kSlopes = 6;       ///< bisections for its slope
constexpr int kLevels = 18;      ///< bisections for its level
constexpr double kSpare = 1.02;  ///< volume that the trial grid must hold, over the carried volume
constexpr double kSteepest_rad = 85 * kDeg;
/// least component of the up direction in the plane of the profile
constexpr double kLeastUp = 0.05;

using Stance = HeapGrid::Stance;

double Holds_m3(const HeapGrid& grid) { return grid.VolumeBelow_m3(grid.highest_m()); }

/// Smallest value in [0, 1] for which `suits` is true, by bisection. `suits` must be true at 1.
template <typename Suits>
double LeastThatSuits(int bisections, const Suits& suits) {
  double low = 0, high = 1;
  for (int k = 0; k < bisections; ++k) {
    const double middle = 0.5 * (low + high);
    (suits(middle) ? high : low) = middle;
  }
  return high;
}

/// Interpolates unit vectors, with share `s` of `b`. Returns `b` where the result has no part in
/// the x-z plane.
Vec3 Between(const Vec3& a, const Vec3& b, double s) {
  const Vec3 mean = (1 - s) * a + s * b;
  return std::hypot(mean.x(), mean.z()) > kLeastUp ? mean.normalized() : b;
}

/// Stance in which the shovel holds the volume: at repose under gravity, or as close to it as
/// possible.
Stance FindStance(const ShovelShape& shape, const CarriedHeap& heap, double cell_m,
                  const HeapRelief& relief) {
  const auto holds = [&](const Vec3& up_B, double slope_rad) {
    return Holds_m3(HeapGrid(shape, {up_B, up_B, slope_rad}, cell_m, relief)) >=
           kSpare * heap.volume_m3;
  };
  const Vec3 level_B = shape.LevelUp_B();
  Vec3 up_B = Between(heap.up_B.normalized(), level_B, 0);
  if (holds(up_B, heap.repose_rad)) return {up_B, heap.surface_up_B, heap.repose_rad};
  if (holds(level_B, heap.repose_rad)) {
    const double turn = LeastThatSuits(
        kTurns, [&](double s) { return holds(Between(up_B, level_B, s), heap.repose_rad); });
    up_B = Between(up_B, level_B, turn);
    return {up_B, up_B, heap.repose_rad};
  }
  const auto slope_rad = [&](double s) {
    return heap.repose_rad + s * (kSteepest_rad - heap.repose_rad);
  };
  const double more =
      LeastThatSuits(kSlopes, [&](double s) { return holds(level_B, slope_rad(s)); });
  return {level_B, level_B, slope_rad(more)};
}

/// Collects the triangles of a surface, clipped where it meets the shell.
class Cutter {
 public:
  Cutter(const HeapGrid& grid, double level_m)
      : grid_(grid), columns_(grid.FilledTo(level_m)), at_column_(columns_.size(), kNone) {}

  void Add(const std::array<std::size_t, 3>& corners) {
    if (std::all_of(corners.begin(), corners.end(),
                    [&](std::size_t n) { return columns_[n].at_shell; })) {
      return;  // the triangle lies on the shell
    }
    std::vector<std::uint32_t> polygon;
    for (std::size_t e = 0; e < 3; ++e) {
      const std::size_t a = corners[e], b = corners[(e + 1) % 3];
      const bool a_is_wet = columns_[a].depth_m() > 0, b_is_wet = columns_[b].depth_m() > 0;
      if (a_is_wet) polygon.push_back(Point(a, a));
      if (a_is_wet != b_is_wet) polygon.push_back(Point(std::min(a, b), std::max(a, b)));
    }
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      surface_.triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
    }
  }
  HeapSurface Take() { return std::move(surface_); }

 private:
  /// Index of the surface point at column `a`, or where the surface meets the shell between `a` and
  /// `b`.
  std::uint32_t Point(std::size_t a, std::size_t b) {
    std::uint32_t& known =
        a == b ? at_column_[a] : crossings_.try_emplace({a, b}, kNone).first->second;
    if (known != kNone) return known;
    known = static_cast<std::uint32_t>(surface_.p_B_m.size());
    const double depth_a_m = columns_[a].depth_m(), depth_b_m = columns_[b].depth_m();
    const double s = a == b ? 0.0 : depth_a_m / (depth_a_m - depth_b_m);
    const auto between = [&](const auto& at_a, const auto& at_b) {
      return ((1 - s) * at_a + s * at_b).eval();
    };
    surface_.p_B_m.push_back(
        between(grid_.At_B(a, columns_[a].surface_m), grid_.At_B(b, columns_[b].surface_m)));
    surface_.floor_B_m.push_back(
        between(grid_.At_B(a, columns_[a].floor_m), grid_.At_B(b, columns_[b].floor_m)));
    surface_.place_m.push_back(between(grid_.PlaceOf(a), grid_.PlaceOf(b)));
    return known;
  }

  const HeapGrid& grid_;
  std::vector<HeapGrid::Column> columns_;
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> at_column_;  ///< index of the point at each column
  std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> crossings_;
  HeapSurface surface_;
};

}  // namespace

HeapSurface MakeHeapSurface(const ShovelShape& shape, const CarriedHeap& heap, double cell_m,
                            const HeapRelief& relief) {
  if (heap.volume_m3 <= 0) return {};
  const Stance stance = FindStance(shape, heap, kCoarse * cell_m, relief);
  const HeapGrid grid(shape, stance, cell_m, relief);
  const double range_m = grid.highest_m() - grid.lowest_m();
  const auto level_m = [&](double s) { return grid.lowest_m() + s * range_m; };
  const double full = LeastThatSuits(
      kLevels, [&](double s) { return grid.VolumeBelow_m3(level_m(s)) >= heap.volume_m3; });
  Cutter cutter(grid, level_m(full));
  grid.ForTriangles([&](std::size_t a, std::size_t b, std::size_t c) { cutter.Add({a, b, c}); });
  return cutter.Take();
}

}  // namespace tera
