#include "sensors/encoder/encoded_axes.h"

#include <algorithm>

namespace tera {

EncodedAxes AxesOf(const EncoderModel& encoder, const MachineModel& machine) {
  EncodedAxes axes;
  if (encoder.joints.empty()) {
    for (std::size_t j = 0; j < machine.joints.size(); ++j) {
      if (machine.joints[j].type != JointType::kFixed) axes.joints.push_back(static_cast<int>(j));
    }
  }
  for (const std::string& name : encoder.joints) {
    const auto& gears = machine.ground_tools.gears;
    const auto gear = std::find_if(gears.begin(), gears.end(),
                                   [&](const RunningGear& g) { return g.name == name; });
    if (const int joint = machine.JointIndex(name); joint >= 0) {
      axes.joints.push_back(joint);
    } else if (gear != gears.end()) {
      axes.gears.push_back(static_cast<int>(gear - gears.begin()));
    } else {
      axes.unknown.push_back(name);
    }
  }
  return axes;
}

std::vector<EncoderAxis> NamesOf(const EncodedAxes& axes, const MachineModel& machine) {
  std::vector<EncoderAxis> names;
  for (const int j : axes.joints) {
    names.push_back({machine.joints[j].name, machine.joints[j].type == JointType::kPrismatic});
  }
  for (const int g : axes.gears) names.push_back({machine.ground_tools.gears[g].name});
  return names;
}

}  // namespace tera
