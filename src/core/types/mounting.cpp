#include "core/types/mounting.h"

#include <fmt/format.h>

namespace tera {

std::string MountingYaml(const std::string& parent_link, const Pose& X_parent_sensor) {
  const Quat q(X_parent_sensor.linear());
  const Vec3 p_m = X_parent_sensor.translation();
  std::string rows;
  for (int r = 0; r < 4; ++r) {
    const auto row = X_parent_sensor.matrix().row(r);
    rows += fmt::format("    - [{}, {}, {}, {}]\n", row[0], row[1], row[2], row[3]);
  }
  return fmt::format(
      "parent_link: {}\nX_parent_sensor:\n  matrix:\n{}  xyz_m: [{:.12g}, {:.12g}, {:.12g}]\n"
      "  quaternion_wxyz: [{}, {}, {}, {}]\n",
      parent_link, rows, p_m.x(), p_m.y(), p_m.z(), q.w(), q.x(), q.y(), q.z());
}

}  // namespace tera
