#include "sim/scenario/driven_ground.h"

#include <cmath>
#include <numbers>

namespace tera {
namespace {

constexpr double kKnot_m = 6, kStep_m = 1, kPastEnds_m = 12;

struct Wave {
  int to_the_turn;
  double share;  ///< amplitude as a share of the radius
};
constexpr Wave kWaves[] = {{2, 0.22}, {3, 0.14}, {5, 0.08}};
constexpr int kCorners = 32;

}  // namespace

std::vector<Vec2> DrivenPath(const Vec2& start_W_m, double heading_rad, double tightest_m,
                             const Vec2& least_W_m, const Vec2& most_W_m, int count,
                             const ShareRow& shares) {
  std::vector<Vec2> path_W_m = {start_W_m};
  const Vec2 before_m(-std::cos(heading_rad), -std::sin(heading_rad));
  while (static_cast<int>(path_W_m.size()) < count) {
    const double way_m = kStep_m * static_cast<double>(path_W_m.size() - 1);
    heading_rad += kStep_m / tightest_m * Wander(shares, 0, way_m, kKnot_m);
    const Vec2 step_m(kStep_m * std::cos(heading_rad), kStep_m * std::sin(heading_rad));
    path_W_m.push_back(path_W_m.back() + step_m);
    const Vec2& at_m = path_W_m.back();
    if ((at_m.array() < least_W_m.array()).any() || (at_m.array() > most_W_m.array()).any()) break;
  }
  path_W_m.push_back(path_W_m.back() +
                     kPastEnds_m * Vec2(std::cos(heading_rad), std::sin(heading_rad)));
  path_W_m.insert(path_W_m.begin(), start_W_m + kPastEnds_m * before_m);
  return path_W_m;
}

std::vector<Vec2> PatchOutline(const Vec2& middle_W_m, double radius_m, const ShareRow& shares) {
  std::vector<Vec2> outline_W_m;
  for (int k = 0; k < kCorners; ++k) {
    const double turn_rad = 2 * std::numbers::pi * k / kCorners;
    double r_m = radius_m;
    std::uint32_t drawn = 0;
    for (const Wave& wave : kWaves) {
      const double phase_rad = 2 * std::numbers::pi * shares(drawn++);
      r_m += radius_m * wave.share * std::cos(wave.to_the_turn * turn_rad + phase_rad);
    }
    outline_W_m.push_back(middle_W_m + r_m * Vec2(std::cos(turn_rad), std::sin(turn_rad)));
  }
  return outline_W_m;
}

}  // namespace tera
