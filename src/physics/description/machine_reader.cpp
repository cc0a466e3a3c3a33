#include <fmt/format.h>

#include <algorithm>

#include "core/config/config_faults.h"
#include "core/config/fault_text.h"
#include "core/config/plain_name.h"
#include "core/config/spelling.h"
#include "core/units.h"
#include "physics/description/machine_reading.h"

namespace tera {
namespace {

Mat3 ReadInertia(const ConfigMap& config) {
  const auto v = config.Numbers("inertia_kgm2", Any("kg m2"), 3, 6);
  if (v.size() != 3 && v.size() != 6) {
    config.Fault(
        "inertia_kgm2",
        {FaultKind::kMistyped,
         fmt::format("{} numbers; need 3 (xx, yy, zz) or 6 (xx, yy, zz, xy, xz, yz)", v.size())});
    return Mat3::Identity();
  }
  Mat3 inertia = Vec3(v[0], v[1], v[2]).asDiagonal();
  if (v.size() == 6) {
    inertia(0, 1) = inertia(1, 0) = v[3];
    inertia(0, 2) = inertia(2, 0) = v[4];
    inertia(1, 2) = inertia(2, 1) = v[5];
  }
  return inertia;
}

Link ReadLink(const std::string& name, const ConfigMap& config) {
  Link link;
  link.name = name;
  link.mass_kg = config.Number("mass_kg", Positive("kg"));
  link.com_B_m = config.Vector3("com_m", Any("m"), Vec3::Zero());
  link.inertia_B_kgm2 = ReadInertia(config);
  link.label = ReadLabel(config, SemanticClass::kVehicle);
  for (const ConfigMap& box : config.List("collision")) {
    link.collision.push_back(
        {.X_BG = box.PoseXyzRpy(), .size_m = box.Vector3("size_m", Positive("m"))});
  }
  for (const ConfigMap& item : config.List("visuals")) {
    Visual visual = ReadMesh(item);
    visual.X_BG = item.PoseXyzRpy();
    if (item.Has("label")) visual.label = ReadLabel(item, link.label);
    link.visuals.push_back(visual);
  }
  return link;
}

JointType ReadJointType(const ConfigMap& config) {
  const std::string type =
      ChoiceOfKeys(config, "type", {"fixed", "revolute", "continuous", "prismatic"});
  if (type == "revolute") return JointType::kRevolute;
  if (type == "continuous") return JointType::kContinuous;
  if (type == "prismatic") return JointType::kPrismatic;
  return JointType::kFixed;
}

Vec3 ReadAxis(const ConfigMap& config) {
  const Vec3 axis = config.Vector3("axis", Any("1"), Vec3::UnitZ());
  if (axis.norm() > 0) return axis.normalized();
  config.Fault("axis", {FaultKind::kOutOfRange,
                        "the axis has no direction; need a vector that is not zero"});
  return Vec3::UnitZ();
}

void ReadLimits(const ConfigMap& config, Joint* joint) {
  if (joint->type != JointType::kRevolute && joint->type != JointType::kPrismatic) return;
  std::string key = "limits_m";
  double unit = 1;
  if (joint->type == JointType::kRevolute) {
    key = config.Has("limits_rad") ? "limits_rad" : "limits_deg";
    if (key == "limits_deg") unit = kDeg;
  }
  const auto limits = config.Numbers(key, Any(key.substr(key.find('_') + 1)), 2, 2);
  if (limits[0] > limits[1]) {
    config.Fault(key, fmt::format("lower limit {} is above upper limit {}; need [lower, upper]",
                                  limits[0], limits[1]));
  }
  joint->lower_rad = std::min(limits[0], limits[1]) * unit;
  joint->upper_rad = std::max(limits[0], limits[1]) * unit;
  joint->initial_rad = std::clamp(0.0, joint->lower_rad, joint->upper_rad);
}

void CheckInitial(const ConfigMap& config, const Joint& joint) {
  if (joint.type != JointType::kRevolute && joint.type != JointType::kPrismatic) return;
  if (joint.initial_rad >= joint.lower_rad && joint.initial_rad <= joint.upper_rad) return;
  const bool linear = joint.type == JointType::kPrismatic;
  const double unit = linear ? 1 : kDeg;
  config.Fault(
      linear ? "initial_m" : "initial_deg",
      {FaultKind::kOutOfRange,
       fmt::format("the joint starts at {:.4g}, outside its limits {:.4g} to {:.4g}",
                   joint.initial_rad / unit, joint.lower_rad / unit, joint.upper_rad / unit)});
}

/// `otherwise` lists the levers of a description without the key.
void ReadLevers(const ConfigMap& config, const std::vector<std::string>& otherwise,
                MachineModel* model) {
  const std::vector<std::string> names = config.Has("levers") ? config.Texts("levers") : otherwise;
  for (std::size_t i = 0; i < names.size(); ++i) {
    Lever lever{.name = names[i], .joint = model->JointIndex(names[i])};
    for (std::size_t g = 0; g < model->ground_tools.gears.size(); ++g) {
      if (model->ground_tools.gears[g].name == lever.name) lever.gear = static_cast<int>(g);
    }
    const std::string place = fmt::format("[{}] '{}'", i, lever.name);
    if (model->LeverIndex(lever.name) >= 0) {
      config.Fault("levers", {FaultKind::kRepeated, place + " is named twice; keep one"});
    } else if (lever.joint < 0 && lever.gear < 0) {
      config.Fault("levers", {FaultKind::kNoSuchName,
                              place + " is neither a joint nor a track or wheel set"});
    } else if (lever.joint >= 0 && lever.gear >= 0) {
      config.Fault("levers", place + " is a joint and a track or wheel set; rename one");
    } else if (lever.joint >= 0 && model->joints[lever.joint].type == JointType::kFixed) {
      config.Fault("levers", place + " is a fixed joint, which cannot move");
    } else if (lever.joint >= 0 && model->joints[lever.joint].following) {
      const int leader = LeaderOf(*model, lever.joint);
      config.Fault("levers", fmt::format("{} follows joint '{}'; name that one", place,
                                         model->joints[leader].name));
    } else if (lever.joint >= 0 && model->joints[lever.joint].gear >= 0) {
      const int gear = model->joints[lever.joint].gear;
      config.Fault("levers", fmt::format("{} turns with wheel set '{}'; name that one", place,
                                         model->ground_tools.gears[gear].name));
    }
    model->levers.push_back(lever);
  }
}

}  // namespace

SemanticClass ReadLabel(const ConfigMap& config, SemanticClass otherwise) {
  const std::string name = config.Text("label", NameOf(otherwise));
  if (const auto label = SemanticClassFromName(name)) return *label;
  std::vector<std::string> known;
  for (const SemanticClassInfo& info : kSemanticClasses) known.emplace_back(info.name);
  config.Fault("label", fault::NotKnown(name, known));
  return otherwise;
}

void ReadJointActuation(const ConfigMap& config, Joint* joint) {
  if (joint->type == JointType::kFixed) return;
  const bool linear = joint->type == JointType::kPrismatic;
  const double unit = linear ? 1 : kDeg;
  const std::string rate_key = linear ? "max_rate_mps" : "max_rate_degps";
  const Range rate = AtLeast(0, linear ? "m/s" : "deg/s");
  if (config.IsList(rate_key)) {
    const auto rates = config.Numbers(rate_key, rate, 2, 2);
    joint->max_rate_positive_radps = rates[0] * unit;
    joint->max_rate_negative_radps = rates[1] * unit;
  } else if (const auto both = config.OptionalNumber(rate_key, rate)) {
    joint->max_rate_positive_radps = joint->max_rate_negative_radps = *both * unit;
  }
  // These keys have no default value: the resolved text must lack them for a joint that takes both
  // limits from its cylinders.
  joint->max_effort_nm = config
                             .OptionalNumber(linear ? "max_effort_n" : "max_effort_nm",
                                             AtLeast(0, linear ? "N" : "N m"))
                             .value_or(joint->max_effort_nm);
  joint->displacement_m3prad =
      config
          .OptionalNumber(linear ? "displacement_m3pm" : "displacement_m3prad",
                          AtLeast(0, linear ? "m3/m" : "m3/rad"))
          .value_or(joint->displacement_m3prad);
  const std::string start_key = linear ? "initial_m" : "initial_deg";
  joint->initial_rad =
      config.Number(start_key, Any(linear ? "m" : "deg"), joint->initial_rad / unit) * unit;
  CheckInitial(config, *joint);
}

Visual ReadMesh(const ConfigMap& config) {
  return {.mesh = config.File("mesh"),
          .node = config.Text("node", ""),
          .place = config.Place("mesh"),
          .scale = config.Number("scale", Positive("1"), 1.0)};
}

int ReadLinkName(const ConfigMap& config, std::string_view key, const MachineModel& model) {
  const std::string name = config.Text(key);
  const int link = model.LinkIndex(name);
  if (link >= 0) return link;
  std::vector<std::string> known;
  for (const Link& l : model.links) known.push_back(l.name);
  if (!name.empty()) {
    config.Fault(key, {FaultKind::kNoSuchName,
                       fmt::format("there is no link '{}'{}", name, DidYouMean(name, known))});
  }
  return 0;
}

MachineParts ReadParts(const ConfigMap& config) {
  MachineParts parts;
  for (const auto& [name, map] : config.NamedMaps("links")) {
    RequirePlainName(map, "", name);
    parts.links.push_back({ReadLink(name, map), {map, ""}});
  }
  for (const auto& [name, map] : config.NamedMaps("joints")) {
    RequirePlainName(map, "", name);
    Joint joint;
    joint.name = name;
    joint.type = ReadJointType(map);
    parts.whole = parts.whole && !IsUnread(map);
    joint.X_PJ = map.PoseXyzRpy();
    if (joint.type != JointType::kFixed) joint.axis_J = ReadAxis(map);
    ReadLimits(map, &joint);
    ReadJointActuation(map, &joint);
    parts.joints.push_back({joint, map.Text("parent"), map.Text("child"), {map, ""}});
  }
  return parts;
}

MachineModel ReadMachine(const ConfigMap& config, AbsentMeshes absent) {
  MachineModel model;
  model.kind = config.Text("kind");
  model.fixed_base = config.Boolean("fixed_base", false);
  const std::optional<MachineParts> parts =
      config.Has("urdf") ? ReadUrdfParts(config, absent) : ReadParts(config);
  if (parts) model.remarks = parts->remarks;
  if (!parts || !OrderIntoTree(*parts, config, &model) || !parts->whole) {
    // The keys that refer to links and joints cannot be checked after such faults.
    for (const char* key : {"tracks", "wheels", "gauge_m", "shovels", "hull_points", "frames",
                            "linkages", "hydraulics", "cylinders", "pumps", "levers", "effects"}) {
      config.Has(key);
    }
    return {.kind = model.kind};
  }
  ReadRunningGear(config, &model);
  ReadEquipment(config, &model);
  ReadHydraulics(config, &model);
  ReadLevers(config, parts->driven, &model);
  config.Has("effects");  // marks the key as read; the effects are read with those of a scenario
  return model;
}

}  // namespace tera
