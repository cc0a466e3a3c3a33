#include "blind/mujoco/cases/effect_parts.h"

#include <fmt/format.h>

namespace tera::blind::mujoco {
namespace {

constexpr double kGravity_mps2 = 9.81;
constexpr double kShear_radps = 70;  ///< of the machine on its bristles, as Shoes has it

}  // namespace

Effect OfJoint(const std::string& name, std::size_t axis, std::string form,
               std::vector<std::string> variables) {
  Effect effect;
  effect.concealed.target = kAxisNames[axis];
  effect.concealed.name = name;
  effect.concealed.form = std::move(form);
  for (const std::string& variable : variables) {
    const bool is_own = variable != "time" && variable.find('/') == std::string::npos;
    effect.concealed.variables.push_back(is_own ? fmt::format("{}/{}", variable, kAxisNames[axis])
                                                : variable);
  }
  effect.concealed.channels = {fmt::format("encoders/{}_radps", kAxisNames[axis]),
                               fmt::format("encoders/{}_rad", kAxisNames[axis])};
  effect.needs.joints = {axis};
  return effect;
}

Effect WithDrive(Effect effect, std::size_t axis, std::function<void(DriveForm*)> change) {
  effect.put = [axis, change = std::move(change)](Forms* forms) {
    change(&forms->plant.drives[axis]);
  };
  return effect;
}

Effect OfSensor(const std::string& sensor, const std::string& name, std::string form) {
  Effect effect;
  effect.concealed.target = sensor;
  effect.concealed.name = name;
  effect.concealed.form = std::move(form);
  effect.concealed.channels = {sensor};
  effect.is_in_plant = false;
  return effect;
}

std::vector<std::size_t> JointsUnder(std::size_t link) {
  std::vector<std::size_t> joints = {kSlew};
  for (std::size_t axis = kBoom; axis < link + 2; ++axis) joints.push_back(axis);
  return joints;
}

std::size_t MovingUnit(const Draw& draw) { return 1 + draw.draws->Below(kUnits - 1); }

std::pair<std::size_t, Effect> OfEncoder(const Draw& draw, const std::string& name,
                                         std::string form) {
  const std::size_t axis = kBoom + draw.draws->Below(3);
  const std::string joint = kAxisNames[axis];
  Effect effect = OfSensor("encoders/" + joint, name, std::move(form));
  effect.concealed.channels = {fmt::format("encoders/{}", joint)};
  // Units on the link and beyond are placed by this angle.
  for (const Mount& unit : draw.numbers.units) {
    if (unit.link + 1 >= axis) effect.concealed.channels.push_back(unit.name);
  }
  effect.needs.joints = {kSlew, axis};
  return {axis, effect};
}

double RelaxationFor_m(double slip, double thrust_of_weight) {
  return thrust_of_weight * kGravity_mps2 / (slip * kShear_radps * kShear_radps / 2);
}

}  // namespace tera::blind::mujoco
