#include "soil/columns/bed.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tera {
namespace {

constexpr double kCell_m = 0.08;
/// a point this far below the floor still counts as in the bed
constexpr double kUnderFloor_m = 0.1;
constexpr double kBesideWall_m = 0.20;   ///< overflowing soil falls this far outside the inner box
constexpr double kOverflow_mps = 0.3;    ///< least outward speed of overflowing soil
constexpr double kLeastShown_m = 0.004;  ///< thinner soil is not drawn
/// Clods as drawn: radius in cells, and depth of the centre below the surface in radii.
constexpr double kClodShown_cells = 0.8, kClodSunk = 0.55;

/// The floor as ground of infinite depth and density 0.
UndisturbedGround FloorOf(const SoilBed& shape) {
  UndisturbedGround floor;
  TerrainGrid& grid = floor.grid;
  grid.nx = std::max(2, static_cast<int>(std::lround(shape.size_m.x() / kCell_m)));
  grid.cell_m = shape.size_m.x() / grid.nx;
  grid.ny = std::max(2, static_cast<int>(shape.size_m.y() / grid.cell_m));
  grid.origin_W_m = -0.5 * grid.cell_m * Vec2(grid.nx - 1, grid.ny - 1);
  floor.base_cells = TerrainGrid::kTileCells;
  floor.base_height_m.assign(static_cast<std::size_t>(floor.base_nx()) * floor.base_ny(), 0.0);
  floor.profiles.push_back(GroundProfile({{std::numeric_limits<double>::infinity(), 0, 0, 1.0}}));
  return floor;
}

}  // namespace

Bed::Bed(const SoilBed& shape, const std::vector<SoilType>& soils)
    : shape_(shape), half_m_(0.5 * shape.size_m), columns_(FloorOf(shape), soils) {}

void Bed::Move(const Pose& X_WB, bool gate_is_open) {
  X_WF_ = X_WB * MakePose(shape_.floor_B_m);
  gate_is_open_ = gate_is_open;
}

bool Bed::Holds(const Vec3& p_W_m) const {
  const Vec3 p_F = X_WF_.inverse() * p_W_m;
  return std::abs(p_F.x()) < half_m_.x() && std::abs(p_F.y()) < half_m_.y() &&
         p_F.z() > -kUnderFloor_m;
}

void Bed::KeepWithinWalls(Vec3* p_F_m, Vec3* v_F_mps) const {
  if (p_F_m->z() > shape_.wall_m) return;
  for (const int axis : {0, 1}) {
    double& p_m = (*p_F_m)[axis];
    const bool is_at_gate = axis == 0 && p_m < 0;
    if (std::abs(p_m) < half_m_[axis] || (is_at_gate && gate_is_open_)) continue;
    p_m = std::copysign(half_m_[axis] - 1e-6, p_m);
    (*v_F_mps)[axis] = 0;
  }
}

void Bed::Deposit(const Vec3& p_W_m, const Spoil& spoil) {
  const Vec3 p_F = X_WF_.inverse() * p_W_m;
  const int i = std::clamp(columns_.NearestI(p_F.x()), 0, columns_.nx() - 1);
  const int j = std::clamp(columns_.NearestJ(p_F.y()), 0, columns_.ny() - 1);
  columns_.Deposit(columns_.Touch(i, j), spoil);
  load_.mass_kg += spoil.mass_kg;
  load_.volume_m3 += spoil.volume_m3;
}

Bed::Overflow Bed::TakeOverflow(int i, int j, double rim_m, const Vec2& v_F_mps) {
  const ColumnId k = columns_.Touch(i, j);
  Overflow fallen;
  const double top_m = columns_.at(k).top_m;
  columns_.TakeLoose(k, top_m - rim_m, &fallen.soil);
  load_.mass_kg -= fallen.soil.mass_kg();
  load_.volume_m3 -= fallen.soil.volume_m3();
  Vec3 v_F(v_F_mps.x(), v_F_mps.y(), 0);
  Vec3 p_F(columns_.x_m(i), columns_.y_m(j), top_m);
  const int place[2] = {i, j}, last[2] = {columns_.nx() - 1, columns_.ny() - 1};
  for (const int axis : {0, 1}) {
    if (place[axis] != 0 && place[axis] != last[axis]) continue;
    const bool is_walled = axis == 1 && i == 0 && gate_is_open_ && top_m < shape_.wall_m;
    if (is_walled) continue;
    const double out = place[axis] == 0 ? -1 : 1;
    p_F[axis] = out * (half_m_[axis] + kBesideWall_m);
    v_F[axis] = out * std::max(kOverflow_mps, out * v_F[axis]);
  }
  fallen.p_W_m = X_WF_ * p_F;
  fallen.v_W_mps = X_WF_.linear() * v_F;
  return fallen;
}

void Bed::Show(std::vector<TerrainSurface::Grain>* grains) const {
  if (load_.mass_kg <= 0) return;
  const double radius_m = kClodShown_cells * columns_.cell_m();
  for (int j = 0; j < columns_.ny(); ++j) {
    for (int i = 0; i < columns_.nx(); ++i) {
      const TerrainSurface::Vertex vertex = columns_.surface().at(i, j);
      if (vertex.height_m < kLeastShown_m) continue;
      const Vec3 p_F(columns_.x_m(i), columns_.y_m(j), vertex.height_m - kClodSunk * radius_m);
      grains->push_back({(X_WF_ * p_F).cast<float>(), static_cast<float>(radius_m),
                         static_cast<std::uint16_t>(7 * i + 131 * j), vertex.cover.soil,
                         vertex.cover.moisture});
    }
  }
}

}  // namespace tera
