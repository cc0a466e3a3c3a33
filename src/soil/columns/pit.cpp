#include "soil/columns/pit.h"

#include <fmt/format.h>

#include <algorithm>

#include "soil/site/outline.h"

namespace tera {

std::vector<PitPlan> ReadPits(const ConfigMap& config, const TerrainGrid& grid) {
  const Vec2 low_m = grid.origin_W_m, high_m(grid.x_m(grid.nx - 1), grid.y_m(grid.ny - 1));
  std::vector<PitPlan> pits;
  for (const ConfigMap& item : config.List("pits")) {
    const PitPlan pit{ReadOutline(item), item.Number("depth_m", Between(0, 20, "m"))};
    const auto beyond = [&](const Vec2& p) {
      return (p.array() < low_m.array()).any() || (p.array() > high_m.array()).any();
    };
    if (std::any_of(pit.outline_W_m.begin(), pit.outline_W_m.end(), beyond)) {
      item.Fault("outline_m",
                 {FaultKind::kOutOfRange,
                  fmt::format("reaches beyond the site, x {:g} to {:g} m, y {:g} to {:g} m",
                              low_m.x(), high_m.x(), low_m.y(), high_m.y())});
    }
    pits.push_back(pit);
  }
  return pits;
}

void Dig(const PitPlan& pit, Columns* ground) {
  if (pit.outline_W_m.empty()) return;  // a faulty outline, which never runs
  Vec2 low_m = pit.outline_W_m.front(), high_m = low_m;
  for (const Vec2& corner : pit.outline_W_m) {
    low_m = low_m.cwiseMin(corner);
    high_m = high_m.cwiseMax(corner);
  }
  for (int j = ground->NearestJ(low_m.y()); j <= ground->NearestJ(high_m.y()); ++j) {
    for (int i = ground->NearestI(low_m.x()); i <= ground->NearestI(high_m.x()); ++i) {
      if (!ground->Contains(i, j)) continue;
      if (!Encloses(pit.outline_W_m, Vec2(ground->x_m(i), ground->y_m(j)))) continue;
      const ColumnId k = ground->Touch(i, j);
      SpoilMix gone;
      ground->Cut(k, ground->at(k).ground_m - pit.depth_m, &gone);
    }
  }
}

}  // namespace tera
