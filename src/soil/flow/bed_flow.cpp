#include "soil/flow/bed_flow.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kTurned_rad = 1e-3;  ///< a smaller rotation leaves soil at rest
constexpr double kOverRim_m = 0.005;  ///< height of soil above the rim before a clod falls
constexpr double kSteepest_rad = 80 * kDeg;

/// Greatest height of soil in a border column, half a cell inside: at repose from the rim.
double Rim_m(const Bed& bed, int i, int j, double repose_rad) {
  const Columns& columns = bed.columns();
  const Vec3 up_F = bed.up_F();
  const int place[2] = {i, j}, last[2] = {columns.nx() - 1, columns.ny() - 1};
  double rim_m = std::numeric_limits<double>::infinity();
  for (const int axis : {0, 1}) {
    if (place[axis] != 0 && place[axis] != last[axis]) continue;
    const bool is_gate = axis == 0 && i == 0 && bed.gate_is_open();
    const double falls_rad = std::atan2(place[axis] == 0 ? up_F[axis] : -up_F[axis], up_F.z());
    const double rises_rad = std::clamp(repose_rad - falls_rad, -kSteepest_rad, kSteepest_rad);
    rim_m = std::min(rim_m,
                     (is_gate ? 0 : bed.wall_m()) + 0.5 * columns.cell_m() * std::tan(rises_rad));
  }
  return std::max(0.0, rim_m);
}

}  // namespace

/// Passes a changed tilt or gate to the avalanche, so that soil at rest may slide.
void BedFlow::Stand(Bed* bed) {
  const Vec3 up_F = bed->up_F();
  const bool is_open = bed->gate_is_open() && up_F.x() > 0;
  if ((up_F - up_F_).norm() < kTurned_rad && is_open == is_open_) return;
  up_F_ = up_F;
  is_open_ = is_open;
  avalanche_.StandOnSteel(up_F, is_open, &bed->columns());
}

void BedFlow::Overflow(int i, int j, Bed* bed, Columns* ground, Grains* grains) const {
  const Columns& columns = bed->columns();
  const double top_m = columns.TopAt(i, j);
  if (top_m <= kOverRim_m) return;
  const bool is_at_gate = i == 0 && bed->gate_is_open();
  const std::uint8_t soil = columns.SoilAt(i, j);
  const double rim_m = is_at_gate && avalanche_.SlidesOnSteel(soil)
                           ? 0.0
                           : Rim_m(*bed, i, j, columns.soils()[soil].repose_angle_rad);
  if (top_m <= rim_m + kOverRim_m) return;
  const Vec2 v_F_mps =
      is_at_gate ? avalanche_.VelocityBeside(columns.IdAt(i, j)) : Vec2(Vec2::Zero());
  const Bed::Overflow fallen = bed->TakeOverflow(i, j, rim_m, v_F_mps);
  grains->Pour(fallen.soil, fallen.p_W_m, fallen.p_W_m, fallen.v_W_mps, ground);
}

void BedFlow::Flow(double dt_s, Bed* bed, Columns* ground, Grains* grains) {
  if (bed->load().mass_kg <= 0) return;
  Stand(bed);
  avalanche_.Flow(dt_s, &bed->columns(), grains);
  const int last_i = bed->columns().nx() - 1, last_j = bed->columns().ny() - 1;
  for (int j = 0; j <= last_j; ++j) {
    for (int i = 0; i <= last_i; i += j == 0 || j == last_j ? 1 : last_i) {
      Overflow(i, j, bed, ground, grains);
    }
  }
}

}  // namespace tera
