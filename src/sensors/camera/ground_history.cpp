#include "sensors/camera/ground_history.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

constexpr int kCells = TerrainGrid::kTileCells, kVertices = kCells + 1;

}  // namespace

void GroundHistory::NoteTile(const TerrainSurface& ground, int a, int b) {
  std::vector<std::optional<TimeNs>>& touched_ns = touched_ns_[ground.tile_index(a, b)];
  if (touched_ns.empty()) touched_ns.resize(kVertices * kVertices);
  for (int j = 0; j < kVertices && b * kCells + j < ground.ny; ++j) {
    for (int i = 0; i < kVertices && a * kCells + i < ground.nx; ++i) {
      const int x = a * kCells + i, y = b * kCells + j;
      if (ground.AsSet(x, y) != now_->AsSet(x, y)) touched_ns[j * kVertices + i] = t_ns_;
    }
  }
}

void GroundHistory::Advance(const TerrainSurface& ground, TimeNs t_ns) {
  t_ns_ = t_ns;
  if (!first_) {
    first_ = now_ = ground;
    touched_ns_.resize(ground.tile_count());
    return;
  }
  TERA_CHECK(static_cast<const TerrainGrid&>(ground) == *first_, ground.nx, ground.ny);
  bool changed = false;
  for (int b = 0; b < ground.tiles_y(); ++b) {
    for (int a = 0; a < ground.tiles_x(); ++a) {
      if (ground.tile_version(a, b) == now_->tile_version(a, b)) continue;
      NoteTile(ground, a, b);
      changed = true;
    }
  }
  if (changed) now_ = ground;
}

std::optional<GroundHistory::State> GroundHistory::At(double x_m, double y_m) const {
  const double gx = (x_m - now_->origin_W_m.x()) / now_->cell_m;
  const double gy = (y_m - now_->origin_W_m.y()) / now_->cell_m;
  if (!(gx >= 0 && gy >= 0 && gx <= now_->nx - 1 && gy <= now_->ny - 1)) return std::nullopt;
  const int i = static_cast<int>(std::lround(gx)), j = static_cast<int>(std::lround(gy));
  State state;
  state.cover = now_->at(i, j).cover;
  state.risen_m = now_->HeightAt(x_m, y_m) - first_->HeightAt(x_m, y_m);
  const int a = std::min(i / kCells, now_->tiles_x() - 1);
  const int b = std::min(j / kCells, now_->tiles_y() - 1);
  const auto& touched_ns = touched_ns_[now_->tile_index(a, b)];
  if (touched_ns.empty()) return state;
  const auto& at_ns = touched_ns[(j - b * kCells) * kVertices + (i - a * kCells)];
  if (at_ns) state.untouched_ns = t_ns_ - *at_ns;
  return state;
}

}  // namespace tera
