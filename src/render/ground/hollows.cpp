#include "render/ground/hollows.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>

namespace tera {
namespace {

constexpr std::array<std::pair<int, int>, 4> kBeside = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
constexpr float kShallow_m = 1e-4f;  ///< shallower hollows do not count

struct Cells {
  int width, height;

  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * width + i; }
  template <typename Visit>
  void ForBeside(std::size_t cell, Visit visit) const {
    const int i = static_cast<int>(cell % width), j = static_cast<int>(cell / width);
    for (const auto& [di, dj] : kBeside) {
      const int a = i + di, b = j + dj;
      if (a >= 0 && b >= 0 && a < width && b < height) visit(index(a, b));
    }
  }
  bool IsBorder(std::size_t cell) const {
    const int i = static_cast<int>(cell % width), j = static_cast<int>(cell / width);
    return i == 0 || j == 0 || i == width - 1 || j == height - 1;
  }
};

/// Flood level of each cell when all hollows are full to the brim.
std::vector<float> Filled(const std::vector<float>& height_m, const Cells& cells) {
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::vector<float> level_m(height_m.size());
  std::vector<std::uint8_t> is_known(height_m.size(), 0);
  for (std::size_t cell = 0; cell < height_m.size(); ++cell) {
    if (!cells.IsBorder(cell)) continue;
    level_m[cell] = height_m[cell];
    is_known[cell] = 1;
    open.emplace(level_m[cell], cell);
  }
  while (!open.empty()) {
    const auto [level, cell] = open.top();
    open.pop();
    cells.ForBeside(cell, [&, level = level](std::size_t beside) {
      if (is_known[beside]) return;
      is_known[beside] = 1;
      level_m[beside] = std::max(level, height_m[beside]);
      open.emplace(level_m[beside], beside);
    });
  }
  return level_m;
}

}  // namespace

std::vector<float> WaterLevels(const std::vector<float>& height_m, int width, int height,
                               double most_m) {
  const Cells cells{width, height};
  const std::vector<float> brim_m = Filled(height_m, cells);
  std::vector<float> water_m(height_m.size(), kDry);
  std::vector<std::uint8_t> is_seen(height_m.size(), 0);
  const auto is_hollow = [&](std::size_t cell) {
    return !is_seen[cell] && brim_m[cell] - height_m[cell] > kShallow_m;
  };
  std::vector<std::size_t> hollow;
  for (std::size_t seed = 0; seed < height_m.size(); ++seed) {
    if (!is_hollow(seed)) continue;
    hollow = {seed};
    is_seen[seed] = 1;
    float bottom_m = height_m[seed];
    for (std::size_t n = 0; n < hollow.size(); ++n) {
      bottom_m = std::min(bottom_m, height_m[hollow[n]]);
      cells.ForBeside(hollow[n], [&](std::size_t beside) {
        if (!is_hollow(beside) || brim_m[beside] != brim_m[seed]) return;
        is_seen[beside] = 1;
        hollow.push_back(beside);
      });
    }
    const float level_m = std::min(brim_m[seed], bottom_m + static_cast<float>(most_m));
    for (const std::size_t cell : hollow) water_m[cell] = level_m;
  }
  return water_m;
}

}  // namespace tera
