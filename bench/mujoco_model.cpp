#include "mujoco_model.h"

#include <fmt/format.h>

#include <stdexcept>

namespace tera::bench {
namespace {

/// A motor closes an error of its rate within this many steps; MuJoCo's is a damper, not a
/// constraint.
constexpr double kMotor_steps = 5;
/// Moves with a joint at the very least: a kilogram at a metre's distance.
constexpr double kLeastInertia_kgm2 = 1;

std::string Text(const Vec3& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

std::string Inertial(const Link& link) {
  const Mat3& I = link.inertia_B_kgm2;
  return fmt::format(
      "<inertial pos='{}' mass='{:.17g}' fullinertia='{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} "
      "{:.17g}'/>",
      Text(link.com_B_m), link.mass_kg, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
}

std::string Limits(const Joint& joint) {
  if (joint.type == JointType::kContinuous) return "limited='false'";
  return fmt::format("limited='true' range='{:.17g} {:.17g}'", joint.lower_rad, joint.upper_rad);
}

/// Link `link` and all that hangs on it, without its opening tag.
std::string Body(const MachineModel& machine, int link) {
  std::string text = Inertial(machine.links[link]);
  for (const Joint& joint : machine.joints) {
    if (joint.parent != link) continue;
    const Eigen::Quaterniond q(joint.X_PJ.linear());
    text += fmt::format("<body name='{}' pos='{}' quat='{:.17g} {:.17g} {:.17g} {:.17g}'>",
                        machine.links[joint.child].name, Text(joint.X_PJ.translation()), q.w(),
                        q.x(), q.y(), q.z());
    if (joint.type != JointType::kFixed) {
      text += fmt::format("<joint name='{}' type='{}' axis='{}' {}/>", joint.name,
                          joint.type == JointType::kPrismatic ? "slide" : "hinge",
                          Text(joint.axis_J), Limits(joint));
    }
    text += Body(machine, joint.child) + "</body>";
  }
  return text;
}

std::string Motors(const MachineModel& machine, double dt_s) {
  std::string text;
  for (const Joint& joint : machine.joints) {
    if (joint.type == JointType::kFixed) continue;
    const double kv =
        kLeastInertia_kgm2 * machine.links[joint.child].mass_kg / (kMotor_steps * dt_s);
    text += fmt::format(
        "<velocity joint='{0}' kv='{1:.17g}' forcelimited='true' "
        "forcerange='-{2:.17g} {2:.17g}'/>",
        joint.name, kv, joint.max_effort_nm);
  }
  return text;
}

}  // namespace

MujocoModel InMujoco(const MachineModel& machine, double dt_s) {
  const std::string xml = fmt::format(
      "<mujoco><compiler angle='radian'/><option timestep='{:.17g}'/>"
      "<worldbody><body name='base'><freejoint/>{}</body></worldbody><actuator>{}</actuator>"
      "</mujoco>",
      dt_s, Body(machine, 0), Motors(machine, dt_s));
  mjVFS files;
  mj_defaultVFS(&files);
  const char* name = "machine.xml";
  mj_makeEmptyFileVFS(&files, name, static_cast<int>(xml.size()));
  xml.copy(static_cast<char*>(files.filedata[0]), xml.size());
  char error[500] = "";
  MujocoModel model(mj_loadXML(name, &files, error, sizeof error));
  mj_deleteVFS(&files);
  if (!model) throw std::runtime_error(fmt::format("MuJoCo refuses the model: {}", error));
  return model;
}

}  // namespace tera::bench
