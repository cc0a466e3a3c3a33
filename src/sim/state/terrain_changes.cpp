#include "sim/state/terrain_changes.h"

#include "core/check.h"

namespace tera {

TerrainTracker::TerrainTracker(const TerrainSurface& ground)
    : known_(ground), version_(static_cast<std::size_t>(ground.tile_count()), 0) {}

TerrainChange TerrainTracker::Find(const TerrainSurface& now) {
  TERA_CHECK(static_cast<const TerrainGrid&>(now) == known_, now.nx, now.ny);
  TerrainChange change;
  for (int b = 0; b < now.tiles_y(); ++b) {
    for (int a = 0; a < now.tiles_x(); ++a) {
      std::uint32_t& seen = version_[static_cast<std::size_t>(now.tile_index(a, b))];
      if (now.tile_version(a, b) == seen) continue;
      seen = now.tile_version(a, b);
      CompareTile(now, a, b, &change);
    }
  }
  change.grains = now.grains();
  return change;
}

void TerrainTracker::CompareTile(const TerrainSurface& now, int a, int b,
                                 TerrainChange* change) const {
  if (!now.IsRefined(a, b)) return;  // unchanged since the start
  if (!known_.IsRefined(a, b)) change->refined_tiles.push_back(now.tile_index(a, b));
  constexpr int kCells = TerrainGrid::kTileCells;
  const int i_end = a == now.tiles_x() - 1 ? now.nx : (a + 1) * kCells;
  const int j_end = b == now.tiles_y() - 1 ? now.ny : (b + 1) * kCells;
  for (int j = b * kCells; j < j_end; ++j) {
    for (int i = a * kCells; i < i_end; ++i) {
      const TerrainSurface::Vertex vertex = now.AsSet(i, j);
      if (vertex != known_.AsSet(i, j)) change->vertices.push_back({i, j, vertex});
    }
  }
}

void Apply(const TerrainChange& change, TerrainSurface* ground) {
  for (const int tile : change.refined_tiles) {
    ground->Refine(tile % ground->tiles_x(), tile / ground->tiles_x());
  }
  for (const TerrainChange::At& at : change.vertices) ground->Set(at.i, at.j, at.vertex);
  ground->SetGrains(change.grains);
}

}  // namespace tera
