#include "physics/actuation/learned_rate.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "physics/actuation/axes.h"

namespace tera {
namespace {

using Kind = LearnedVariable::Kind;

}  // namespace

double LearnedRate::Step(double rate_radps, const LearnedInput& input) {
  double x = 0;
  switch (effect_.variable.kind) {
    case Kind::kLever:
      x = input.lever;
      break;
    case Kind::kLeverWay:
      x = way_.Step(input.lever);
      break;
    case Kind::kPosition:
      x = input.position_rad;
      break;
    case Kind::kLoad:
      x = input.load_nm;
      break;
    case Kind::kRate:
      x = rate_radps;
      break;
    case Kind::kTime:
      x = input.time_s;
      break;
  }
  const double value = effect_.At(x);
  if (effect_.is_share) return rate_radps * (1 + value);
  const double most_radps = std::abs(rate_radps);
  return rate_radps + std::clamp(value, -most_radps, most_radps);
}

std::vector<LearnedVariable> LearnedVariablesOf(const MachineModel& model, std::size_t axis) {
  const bool slides =
      axis < model.joints.size() && model.joints[axis].type == JointType::kPrismatic;
  const std::string name = NameOfAxis(model, axis);
  std::vector<LearnedVariable> variables;
  for (const auto& [kind, prefix] :
       {std::pair(Kind::kLever, "lever/"), std::pair(Kind::kLeverWay, "lever_way/")}) {
    for (std::size_t other = 0; other < model.joints.size() + model.gear_drives.size(); ++other) {
      if (other != axis && !HasLever(model, other)) continue;
      variables.push_back({prefix + NameOfAxis(model, other), "1", kind, other});
    }
  }
  variables.push_back({"position/" + name, slides ? "m" : "rad", Kind::kPosition, axis});
  variables.push_back({"load/" + name, slides ? "N" : "N m", Kind::kLoad, axis});
  variables.push_back({"rate", slides ? "m/s" : "rad/s", Kind::kRate, axis});
  variables.push_back({"time", "s", Kind::kTime, axis});
  return variables;
}

const LearnedEffect* LearnedAt(const MachineEffects& effects, std::size_t axis) {
  return axis < effects.learned.size() && effects.learned[axis] ? &*effects.learned[axis] : nullptr;
}

}  // namespace tera
