#include "blind/mujoco/plant/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/check.h"

namespace tera::blind::mujoco {
namespace {

constexpr double kGravity_mps2 = 9.8071;
constexpr double kSprocketInertia_kgm2 = 25;
constexpr double kPin_radps2 = 4;    ///< at which a pin's friction stops a link behind a gap
constexpr double kMotorShare = 0.2;  ///< of a joint's inertia that is the motor's, before a gap

std::string Text(const Vec3& v) {
  return fmt::format("{:.12g} {:.12g} {:.12g}", v.x(), v.y(), v.z());
}

std::string Text(const Quat& q) {
  return fmt::format("{:.12g} {:.12g} {:.12g} {:.12g}", q.w(), q.x(), q.y(), q.z());
}

Quat FromRpy(const Vec3& rpy_rad) {
  return Quat(Eigen::AngleAxisd(rpy_rad.z(), Vec3::UnitZ()) *
              Eigen::AngleAxisd(rpy_rad.y(), Vec3::UnitY()) *
              Eigen::AngleAxisd(rpy_rad.x(), Vec3::UnitX()));
}

std::string Site(const Mount& mount, const Misplaced& real) {
  return fmt::format("<site name='{}' pos='{}' quat='{}'/>", mount.name,
                     Text(Vec3(mount.xyz_m + real.xyz_m)), Text(FromRpy(real.rpy_rad)));
}

/// Writes bodies, from the tip inwards.
class Bodies {
 public:
  Bodies(const MachineNumbers& numbers, const PlantForm& form) : numbers_(numbers), form_(form) {}

  std::string Machine() const {
    std::string text = "<body name='undercarriage'><freejoint name='base'/>";
    text += Filled(kUndercarriage);
    for (const std::size_t i : {kLeftTrack, kRightTrack}) {
      text += fmt::format(
          "<body name='{0}' pos='0 {1:.12g} {2:.12g}'><inertial pos='0 0 0' mass='1' "
          "diaginertia='0.1 0.1 0.1'/><joint name='{0}' type='hinge' axis='0 1 0' "
          "armature='{3:.12g}'/></body>",
          kAxisNames[i], (i == kLeftTrack ? 0.5 : -0.5) * numbers_.gauge_m, numbers_.radius_m,
          kSprocketInertia_kgm2);
    }
    return text + Jointed(kSlew) + "</body>";
  }

 private:
  std::string Filled(std::size_t link) const {
    const LinkNumbers& l = numbers_.links[link];
    const double factor = form_.mass[link];
    std::string text =
        fmt::format("<inertial pos='{}' mass='{:.12g}' diaginertia='{}'/>", Text(l.com_m),
                    l.mass_kg * factor, Text(Vec3(l.inertia_kgm2 * factor)));
    for (std::size_t u = 0; u < kUnits; ++u) {
      if (numbers_.units[u].link == link) text += Site(numbers_.units[u], form_.units[u]);
    }
    for (std::size_t r = 0; r < kReceivers; ++r) {
      if (numbers_.antennas[r].link == link) text += Site(numbers_.antennas[r], form_.antennas[r]);
    }
    return text;
  }

  std::string Jointed(std::size_t axis) const {
    const JointNumbers& joint = numbers_.joints[axis];
    const std::string name = kAxisNames[axis];
    const double gap_rad = form_.drives[axis].gap_rad;
    std::string open, close = "</body>";
    if (gap_rad > 0) {  // a motor of its own, and the link behind the gap
      open = fmt::format(
          "<body name='{0}_motor' pos='{1}'><inertial pos='0 0 0' mass='2' diaginertia='0.2 0.2 "
          "0.2'/><joint name='{0}' type='hinge' axis='{2}'/><body name='{3}'><joint "
          "name='{0}_gap' type='hinge' axis='{2}' limited='true' range='{4:.12g} {5:.12g}' "
          "solreflimit='0.008 1'/>",
          name, Text(joint.pin_m), Text(joint.axis), kLinkNames[axis - 1], -gap_rad / 2,
          gap_rad / 2);
      close += "</body>";
    } else {
      open = fmt::format("<body name='{}' pos='{}'><joint name='{}' type='hinge' axis='{}' {}/>",
                         kLinkNames[axis - 1], Text(joint.pin_m), name, Text(joint.axis),
                         Stops(joint));
    }
    std::string inside = Filled(axis - 1);
    if (axis + 1 < kAxisCount) {
      inside += Jointed(axis + 1);
    } else if (form_.payload_kg > 0) {
      inside += fmt::format(
          "<body name='payload' pos='{}'><inertial pos='0 0 0' mass='{:.12g}' diaginertia='5 5 "
          "5'/></body>",
          Text(numbers_.links[kBucketLink].com_m), form_.payload_kg);
    }
    return open + inside + close;
  }

  static std::string Stops(const JointNumbers& joint) {
    if (!joint.has_stops) return "limited='false'";
    return fmt::format("limited='true' range='{:.12g} {:.12g}'", joint.lower_rad, joint.upper_rad);
  }

  const MachineNumbers& numbers_;
  const PlantForm& form_;
};

std::string Filter(const std::string& name, const char* joint, double time_s) {
  return fmt::format(
      "<general name='{}' joint='{}' dyntype='filter' dynprm='{:.12g}' gainprm='0'/>", name, joint,
      time_s);
}

/// Stroke range of a cylinder, which ends with the joint's.
std::string Stroke(const JointNumbers& joint) {
  if (!joint.has_stops) return "";
  return fmt::format("actlimited='true' actrange='{:.12g} {:.12g}'", joint.lower_rad,
                     joint.upper_rad);
}

/// MuJoCo wants those without a state of their own first.
std::string Actuators(const MachineNumbers& numbers, const PlantForm& form) {
  std::string motors, rest;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const DriveForm& drive = form.drives[i];
    const std::string name = kAxisNames[i];
    // Stiffness and damping follow from the inertia, which MuJoCo tells: SetStiffness.
    if (drive.motor_s > 0) {
      motors += fmt::format("<general name='{0}' joint='{0}' biastype='affine'/>", name);
    } else {
      rest += fmt::format(
          "<general name='{0}' joint='{0}' dyntype='integrator' biastype='affine' {1}/>", name,
          Stroke(numbers.joints[i]));
    }
    rest += Filter(name + "_pilot", kAxisNames[i], drive.pilot_s);
    if (drive.second_pilot_s > 0) {
      rest += Filter(name + "_second_pilot", kAxisNames[i], drive.second_pilot_s);
    }
    for (int k = 0; k < drive.bus.line_stages; ++k) {
      rest += Filter(fmt::format("{}_line_{}", name, k), kAxisNames[i],
                     drive.bus.delay_s / drive.bus.line_stages);
    }
  }
  return motors + rest;
}

std::string Sensors(const MachineNumbers& numbers) {
  std::string text;
  for (const Mount& unit : numbers.units) {
    text += fmt::format("<gyro name='{0}_w' site='{0}'/><accelerometer name='{0}_a' site='{0}'/>",
                        unit.name);
  }
  for (const Mount& antenna : numbers.antennas) {
    text += fmt::format("<framepos name='{0}_p' objtype='site' objname='{0}'/>", antenna.name);
  }
  return text;
}

/// A seized pin or bearing acts on what is behind a gap, against what the motor stands on.
std::string Tendons(const PlantForm& form) {
  std::string text;
  for (std::size_t i = kSlew; i < kAxisCount; ++i) {
    if (form.drives[i].gap_rad <= 0) continue;
    text += fmt::format(
        "<fixed name='{0}_pin' frictionloss='1'><joint joint='{0}' coef='1'/><joint "
        "joint='{0}_gap' coef='1'/></fixed>",
        kAxisNames[i]);
  }
  return text.empty() ? "" : "<tendon>" + text + "</tendon>";
}

ModelPtr Compiled(const std::string& xml) {
  mjVFS files;
  mj_defaultVFS(&files);
  mj_makeEmptyFileVFS(&files, "machine.xml", static_cast<int>(xml.size()));
  xml.copy(static_cast<char*>(files.filedata[0]), xml.size());
  char error[500] = "";
  ModelPtr model(mj_loadXML("machine.xml", &files, error, sizeof error));
  mj_deleteVFS(&files);
  TERA_CHECK(model != nullptr, std::string(error), xml);
  return model;
}

void FindNames(const MachineNumbers& numbers, const PlantForm& form, Model* out) {
  const mjModel* m = out->model.get();
  const auto id = [m](mjtObj kind, const std::string& name) {
    return mj_name2id(m, kind, name.c_str());
  };
  const auto place = [&](const std::string& name) { return m->sensor_adr[id(mjOBJ_SENSOR, name)]; };
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const std::string name = kAxisNames[i];
    out->joint[i] = id(mjOBJ_JOINT, name);
    out->gap[i] = id(mjOBJ_JOINT, name + "_gap");
    out->drive[i] = id(mjOBJ_ACTUATOR, name);
    out->pilot[i] = id(mjOBJ_ACTUATOR, name + "_pilot");
    out->second_pilot[i] = id(mjOBJ_ACTUATOR, name + "_second_pilot");
    for (int k = 0; k < form.drives[i].bus.line_stages; ++k) {
      out->line[i].at(k) = id(mjOBJ_ACTUATOR, fmt::format("{}_line_{}", name, k));
    }
  }
  out->base = id(mjOBJ_BODY, "undercarriage");
  for (std::size_t u = 0; u < kUnits; ++u) {
    out->gyro[u] = place(numbers.units[u].name + "_w");
    out->accelerometer[u] = place(numbers.units[u].name + "_a");
  }
  for (std::size_t r = 0; r < kReceivers; ++r) {
    out->antenna[r] = place(numbers.antennas[r].name + "_p");
  }
}

/// Inertia about each joint at the machine's start; for a sprocket, of half the machine.
PerAxis<double> Inertias_kgm2(const MachineNumbers& numbers, const Model& model, mjData* data) {
  const mjModel* m = model.model.get();
  std::vector<double> full(static_cast<std::size_t>(m->nv) * m->nv);
  mj_fullM(m, full.data(), data->qM);
  PerAxis<double> inertia{};
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const int dof = m->jnt_dofadr[model.joint[i]];
    inertia[i] = full[static_cast<std::size_t>(dof) * m->nv + dof];
  }
  const double half_kg = mj_getTotalmass(m) / 2;
  for (const std::size_t i : {kLeftTrack, kRightTrack}) {
    inertia[i] += half_kg * numbers.radius_m * numbers.radius_m;
  }
  return inertia;
}

void SetStiffness(const PlantForm& form, const PerAxis<double>& inertia_kgm2, Model* out) {
  mjModel* m = out->model.get();
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const DriveForm& drive = form.drives[i];
    mjtNum* gain = m->actuator_gainprm + out->drive[i] * mjNGAIN;
    mjtNum* bias = m->actuator_biasprm + out->drive[i] * mjNBIAS;
    if (drive.motor_s > 0) {
      gain[0] = inertia_kgm2[i] / drive.motor_s;
      bias[2] = -gain[0];
      continue;
    }
    const OilNumbers& oil = drive.oil;
    gain[0] = inertia_kgm2[i] * oil.natural_radps * oil.natural_radps;
    bias[1] = -gain[0];
    bias[2] = -2 * oil.damping * inertia_kgm2[i] * oil.natural_radps;
    if (drive.gap_rad <= 0) continue;
    const int dof = m->jnt_dofadr[out->joint[i]];
    m->dof_armature[dof] = kMotorShare * inertia_kgm2[i];
    // Stops what it holds faster than an operator eases the slew out, so that the gap stays closed
    // until the way is reversed.
    m->tendon_frictionloss[mj_name2id(m, mjOBJ_TENDON,
                                      fmt::format("{}_pin", kAxisNames[i]).c_str())] =
        kPin_radps2 * inertia_kgm2[i];
  }
}

/// Weight times reach of all beyond a joint that its axis lifts, the machine stretched out; of the
/// slew what a slope of 0.1 asks.
PerAxis<double> RatedLoads_nm(const MachineNumbers& numbers) {
  PerAxis<double> rated{};
  double mass_kg = 0, moment_kgm = 0;
  for (std::size_t axis = kBucket; axis >= kSlew; --axis) {
    const LinkNumbers& link = numbers.links[axis - 1];
    const double beyond_m = axis == kBucket ? 0 : numbers.joints[axis + 1].pin_m.norm();
    moment_kgm += mass_kg * beyond_m + link.mass_kg * std::abs(link.com_m.x());
    mass_kg += link.mass_kg;
    rated[axis] = kGravity_mps2 * moment_kgm * (axis == kSlew ? 0.1 : 1);
  }
  for (const std::size_t i : {kLeftTrack, kRightTrack}) {
    rated[i] = kGravity_mps2 * 0.2 * (mass_kg + numbers.links[0].mass_kg) / 2 * numbers.radius_m;
  }
  return rated;
}

}  // namespace

Model BuildModel(const MachineNumbers& numbers, const PlantForm& form, const Start& start) {
  const std::string xml = fmt::format(
      "<mujoco><compiler angle='radian'/><option timestep='{}' gravity='0 0 {}' "
      "integrator='Euler'/><worldbody>{}</worldbody>{}<actuator>{}</actuator><sensor>{}</sensor>"
      "</mujoco>",
      kStep_s, -kGravity_mps2, Bodies(numbers, form).Machine(), Tendons(form),
      Actuators(numbers, form), Sensors(numbers));
  Model out;
  out.model = Compiled(xml);
  FindNames(numbers, form, &out);
  out.rated_nm = RatedLoads_nm(numbers);
  const DataPtr data(mj_makeData(out.model.get()));
  PlaceAt(out, start, data.get());
  mj_forward(out.model.get(), data.get());
  SetStiffness(form, Inertias_kgm2(numbers, out, data.get()), &out);
  mj_setConst(out.model.get(), data.get());  // stops and friction are as stiff as inertias allow
  return out;
}

void PlaceAt(const Model& model, const Start& start, mjData* data) {
  const mjModel* m = model.model.get();
  mj_resetData(m, data);
  const Quat q = start.ground.AttitudeAt(0, 0, start.yaw_rad);
  const double pose[7] = {0, 0, start.ground.Height_m(0, 0), q.w(), q.x(), q.y(), q.z()};
  std::copy_n(pose, 7, data->qpos);
  for (std::size_t i = kSlew; i < kAxisCount; ++i) {
    data->qpos[m->jnt_qposadr[model.joint[i]]] = start.joints_rad[i - kSlew];
    if (model.StateOf(model.drive[i]) >= 0) {
      data->act[model.StateOf(model.drive[i])] = start.joints_rad[i - kSlew];
    }
  }
}

}  // namespace tera::blind::mujoco
