#include "physics/actuation/axes.h"

#include <algorithm>

namespace tera {

std::string NameOfAxis(const MachineModel& model, std::size_t axis) {
  return axis < model.joints.size() ? model.joints[axis].name
                                    : model.ground_tools.gears[axis - model.joints.size()].name;
}

int AxisNamed(const MachineModel& model, const std::string& name) {
  if (const int joint = model.JointIndex(name); joint >= 0) return joint;
  for (std::size_t g = 0; g < model.ground_tools.gears.size(); ++g) {
    if (model.ground_tools.gears[g].name == name) return static_cast<int>(model.joints.size() + g);
  }
  return -1;
}

bool HasLever(const MachineModel& model, std::size_t axis) {
  const auto joints = static_cast<int>(model.joints.size());
  return std::any_of(model.levers.begin(), model.levers.end(), [&](const Lever& lever) {
    return (lever.joint >= 0 ? lever.joint : joints + lever.gear) == static_cast<int>(axis);
  });
}

}  // namespace tera
