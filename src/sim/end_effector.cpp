#include "sim/end_effector.h"

namespace tera {

std::optional<EndEffector> EndEffectorOf(const MachineModel& model) {
  const std::vector<Shovel>& shovels = model.ground_tools.shovels;
  for (std::size_t s = 0; s < shovels.size(); ++s) {
    if (shovels[s].capacity_m3 <= 0) continue;
    const Vec2& edge = shovels[s].profile_B_m.front();
    return EndEffector{static_cast<int>(s), shovels[s].link, MakePose(Vec3(edge.x(), 0, edge.y()))};
  }
  return std::nullopt;
}

}  // namespace tera
