#include "soil/flow/bed_flow.h"

#include <algorithm>

namespace tera {
namespace {

constexpr double kTurned = 2e-3;   ///< by less a floor's slope has not changed
constexpr double kUpright = 0.05;  ///< least part of a floor's normal upwards

}  // namespace

/// What rested may slide on a floor that stands otherwise now.
void BedFlow::Tilt(Bed* bed) {
  const Vec3 up_F = bed->X_WF().linear().row(2);
  const Vec2 tilt = up_F.head<2>() / std::max(up_F.z(), kUpright);
  if ((tilt - tilt_).norm() < kTurned) return;
  tilt_ = tilt;
  avalanche_.Tilt(tilt);
  Columns& columns = bed->columns();
  for (int j = 0; j < columns.ny(); ++j) {
    for (int i = 0; i < columns.nx(); ++i) columns.Unblock(columns.Touch(i, j));
  }
}

void BedFlow::Flow(double dt_s, Bed* bed, Columns* ground, Grains* grains) {
  if (bed->load().mass_kg <= 0) return;
  Tilt(bed);
  avalanche_.Flow(dt_s, &bed->columns(), grains);
  for (const Bed::Overflow& fallen : bed->TakeOverflow()) {
    grains->Pour(fallen.soil, fallen.p_W_m, fallen.p_W_m, fallen.v_W_mps, ground);
  }
}

}  // namespace tera
