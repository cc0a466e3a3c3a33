#include "diagnose/sensors/estimated_joints.h"

#include <algorithm>

namespace tera {
namespace {

bool HasLever(const MachineModel& model, std::size_t joint) {
  return std::any_of(model.levers.begin(), model.levers.end(),
                     [&](const Lever& lever) { return lever.joint == static_cast<int>(joint); });
}

bool HasEncoder(const Measurements& measured, const std::string& joint) {
  return std::any_of(
      measured.encoders.begin(), measured.encoders.end(), [&](const NamedEncoders& named) {
        const auto& axes = named.recording.axes;
        return std::any_of(axes.begin(), axes.end(),
                           [&](const EncoderAxis& axis) { return axis.name == joint; });
      });
}

}  // namespace

std::vector<std::size_t> EstimatedJoints(const DiagnosisInput& input,
                                         const Measurements& measured) {
  const MachineModel& model = *input.model;
  std::vector<bool> is_on_way(model.joints.size(), false);
  for (std::size_t s = 0; s < input.sensors.size(); ++s) {
    if (measured.imus[s].empty() && measured.gnss[s].empty()) continue;
    for (int link = model.LinkIndex(input.sensors[s].link); link > 0;
         link = model.joints[static_cast<std::size_t>(link) - 1].parent) {
      is_on_way[static_cast<std::size_t>(link) - 1] = true;
    }
  }
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (!is_on_way[j] || model.joints[j].type == JointType::kFixed) continue;
    if (HasLever(model, j) || HasEncoder(measured, model.joints[j].name)) joints.push_back(j);
  }
  return joints;
}

}  // namespace tera
