#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/config/config_faults.h"
#include "core/config/plain_name.h"
#include "core/config/spelling.h"
#include "core/units.h"
#include "physics/actuation/hydraulics.h"
#include "physics/actuation/linkage.h"
#include "physics/description/machine_reading.h"

namespace tera {
namespace {

/// Number of sample positions over a joint's travel.
constexpr int kTravelSamples = 721;
/// Linkages must close within this margin too, because a loaded stop yields a little.
constexpr double kTravelMargin_rad = 0.02;
constexpr double kLeastArm_m = 0.005;  ///< with a smaller lever arm a cylinder is at a dead centre
constexpr double kPlaneTolerance_m = 1e-4;  ///< tolerance for pins to lie in one plane
constexpr int kMostCylinders = 4;

std::set<int> JointsToRoot(const MachineModel& model, int link) {
  std::set<int> joints;
  for (; link > 0; link = model.joints[link - 1].parent) joints.insert(link - 1);
  return joints;
}

/// The only joint that moves between two links, or -1 after a fault.
int JointBetween(const ConfigMap& config, const MachineModel& model, int a, int b) {
  const std::set<int> from_a = JointsToRoot(model, a), from_b = JointsToRoot(model, b);
  std::vector<int> between;
  std::vector<std::string> names;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const int joint = static_cast<int>(j);
    if (from_a.contains(joint) == from_b.contains(joint)) continue;
    if (model.joints[j].type == JointType::kFixed) continue;
    between.push_back(joint);
    names.push_back(model.joints[j].name);
  }
  if (between.size() == 1) return between[0];
  const std::string &name_a = model.links[a].name, &name_b = model.links[b].name;
  config.Fault(
      "", between.empty()
              ? fmt::format("no joint moves between links '{}' and '{}'; need one", name_a, name_b)
              : fmt::format("joints {} move between links '{}' and '{}'; need one alone",
                            fmt::join(names, ", "), name_a, name_b));
  return -1;
}

/// A pin on a link. OnJointLink moves it to the link of `joint` that it is rigidly attached to.
struct Pin {
  int link = 0;
  Vec3 p_m = Vec3::Zero();
};

Pin OnJointLink(const MachineModel& model, int joint, const Pin& pin) {
  const bool moves = JointsToRoot(model, pin.link).contains(joint);
  const int link = moves ? model.joints[joint].child : model.joints[joint].parent;
  const std::vector<Pose> X_WL =
      ForwardKinematics(model, Pose::Identity(), std::vector<double>(model.joints.size(), 0.0));
  return {link, X_WL[link].inverse() * X_WL[pin.link] * pin.p_m};
}

Pin ReadPin(const ConfigMap& config, const MachineModel& model) {
  return {ReadLinkName(config, "link", model), config.Vector3("pin_m", Any("m"))};
}

std::optional<Visual> ReadOptionalMesh(const ConfigMap& config) {
  if (!config.Has("mesh")) return std::nullopt;
  return ReadMesh(config);
}

/// Sample positions over a joint's travel, extended by `margin`.
std::vector<double> Travel(const Joint& joint, double margin) {
  const bool endless = joint.type == JointType::kContinuous;
  const double lower = endless ? -std::numbers::pi : joint.lower_rad - margin;
  const double upper = endless ? std::numbers::pi : joint.upper_rad + margin;
  std::vector<double> travel;
  for (int i = 0; i < kTravelSamples; ++i) {
    travel.push_back(lower + (upper - lower) * i / (kTravelSamples - 1));
  }
  return travel;
}

/// Position of a joint for messages.
std::string Shown(const Joint& joint, double q) {
  return joint.type == JointType::kPrismatic ? fmt::format("{:.3f} m", q)
                                             : fmt::format("{:.1f} deg", q / kDeg);
}

bool CheckCloses(const ConfigMap& config, const MachineModel& model, const FourBar& linkage) {
  const Joint& joint = model.joints[linkage.joint];
  const Vec3 axis_P = joint.X_PJ.linear() * joint.axis_J;
  const Vec3 apart_m =
      joint.X_PJ * JointMotion(joint, 0) * linkage.coupler_pin_B_m - linkage.rocker_pin_P_m;
  if (std::abs(apart_m.dot(axis_P)) > kPlaneTolerance_m) {
    config.Fault("", fmt::format("the pins of rocker and coupler lie {:.4f} m apart along the "
                                 "axis of joint '{}'; need them in one plane across it",
                                 apart_m.dot(axis_P), joint.name));
    return false;
  }
  const std::vector<double> travel = Travel(joint, kTravelMargin_rad);
  const auto open = [&](double q) { return !SolveFourBar(model, linkage, q).has_value(); };
  const auto first_open = std::find_if(travel.begin(), travel.end(), open);
  if (first_open == travel.end()) return true;
  const bool nowhere = std::all_of(travel.begin(), travel.end(), open);
  const Vec3 gap_m = joint.X_PJ * JointMotion(joint, *first_open) * linkage.coupler_pin_B_m -
                     linkage.rocker_pin_P_m;
  config.Fault(
      "", fmt::format(
              "rocker ({:.3f} m) and coupler ({:.3f} m) do not meet {}: their pins "
              "are {:.3f} m apart; need lengths that close it over the joint's "
              "whole range",
              linkage.rocker_m, linkage.coupler_m,
              nowhere ? fmt::format("anywhere in the range of joint '{}'", joint.name)
                      : fmt::format("at {} of joint '{}'", Shown(joint, *first_open), joint.name),
              gap_m.norm()));
  return false;
}

/// True if the linkage is usable.
bool ReadLinkage(const std::string& name, const ConfigMap& config, MachineModel* model) {
  const std::size_t faults_before = FaultCount(config);
  const ConfigMap rocker = config.Map("rocker"), coupler = config.Map("coupler");
  const Pin rocker_pin = ReadPin(rocker, *model), coupler_pin = ReadPin(coupler, *model);
  FourBar linkage{
      .name = name,
      .rocker_m = rocker.Number("length_m", Positive("m")),
      .coupler_m = coupler.Number("length_m", Positive("m")),
      .branch = config.Choice("branch", {"positive", "negative"}) == "negative" ? -1 : 1,
      .rocker = ReadOptionalMesh(rocker),
      .coupler = ReadOptionalMesh(coupler)};
  if (FaultCount(config) > faults_before) return false;
  const int joint = JointBetween(config, *model, rocker_pin.link, coupler_pin.link);
  if (joint < 0) return false;
  linkage.joint = joint;
  const Pin fixed = OnJointLink(*model, joint, rocker_pin);
  const Pin moving = OnJointLink(*model, joint, coupler_pin);
  linkage.rocker_pin_P_m = fixed.p_m;
  linkage.coupler_pin_B_m = moving.p_m;
  if (model->joints[joint].type == JointType::kPrismatic) {
    config.Fault("",
                 fmt::format("joint '{}' slides; need one that turns", model->joints[joint].name));
    return false;
  }
  if (moving.link != model->joints[joint].child) {
    config.Fault("rocker", fmt::format("its link moves with joint '{}'; need the rocker on the "
                                       "joint's parent side and the coupler on its child",
                                       model->joints[joint].name));
    return false;
  }
  const bool closes = CheckCloses(config, *model, linkage);
  model->linkages.push_back(linkage);
  return closes;
}

void ReadPressure(const ConfigMap& config, const std::optional<ConfigMap>& hydraulics,
                  Cylinder* cylinder) {
  const auto own = config.OptionalNumber("relief_pa", Positive("Pa"));
  const auto common = hydraulics ? hydraulics->OptionalNumber("relief_pa", Positive("Pa")) : own;
  if (!own && !common) {
    config.Fault("relief_pa",
                 {FaultKind::kMissing,
                  "missing; need it here or as hydraulics.relief_pa for all cylinders"});
  }
  cylinder->relief_pa = own.value_or(common.value_or(1.0));
  if (hydraulics) {
    cylinder->return_pressure_pa = hydraulics->Number("return_pressure_pa", AtLeast(0, "Pa"), 0.0);
  }
}

/// Reads bore, rod and pressures.
void ReadPiston(const ConfigMap& config, const std::optional<ConfigMap>& hydraulics,
                Cylinder* cylinder) {
  cylinder->bore_m = config.Number("bore_m", Positive("m"));
  cylinder->rod_diameter_m = config.Number("rod_diameter_m", AtLeast(0, "m"));
  ReadPressure(config, hydraulics, cylinder);
  if (cylinder->rod_diameter_m >= cylinder->bore_m) {
    config.Fault("rod_diameter_m",
                 fmt::format("a rod of {} m does not fit the bore of {} m; need a thinner rod",
                             cylinder->rod_diameter_m, cylinder->bore_m));
    cylinder->rod_diameter_m = 0;
  }
  const double least_pa =
      cylinder->return_pressure_pa * HeadArea_m2(*cylinder) / RodArea_m2(*cylinder);
  if (cylinder->relief_pa <= least_pa) {
    config.Fault("relief_pa",
                 {FaultKind::kOutOfRange,
                  fmt::format("at {:.3g} Pa the cylinder cannot pull against the return "
                              "pressure; need more than {:.3g} Pa",
                              cylinder->relief_pa, least_pa)});
  }
}

/// Sets the lengths over the joint's travel. A cylinder with a bore must be able to move its joint
/// over the whole travel.
void SetTravel(const ConfigMap& config, const MachineModel& model, Cylinder* cylinder) {
  const Joint& joint = model.joints[cylinder->joint];
  CylinderReach least_arm{.arm_m = std::numeric_limits<double>::infinity()};
  double least_arm_at = 0, first_arm_m = 0;
  cylinder->shortest_m = std::numeric_limits<double>::infinity();
  for (const double q : Travel(joint, 0)) {
    const CylinderReach reach = ReachOf(model, *cylinder, q);
    cylinder->shortest_m = std::min(cylinder->shortest_m, reach.length_m);
    cylinder->longest_m = std::max(cylinder->longest_m, reach.length_m);
    if (first_arm_m == 0) first_arm_m = reach.arm_m;
    const double arm_m = std::copysign(1.0, first_arm_m) * reach.arm_m;
    if (arm_m < least_arm.arm_m) least_arm = {reach.length_m, arm_m}, least_arm_at = q;
  }
  if (cylinder->bore_m == 0) return;
  if (!(least_arm.arm_m > kLeastArm_m)) {
    config.Fault(
        "", fmt::format("the cylinder is at or past a dead point at {} of joint '{}' (lever "
                        "arm {:.4f} m); need pins that let it move the joint over its "
                        "whole range",
                        Shown(joint, least_arm_at), joint.name, std::max(0.0, least_arm.arm_m)));
  }
  if (cylinder->longest_m >= 2 * cylinder->shortest_m) {
    config.Fault("", fmt::format("{:.3f} m long at its longest and {:.3f} m at its shortest; a "
                                 "cylinder reaches less than twice its shortest length",
                                 cylinder->longest_m, cylinder->shortest_m));
  }
}

/// Reads `rod:` for a known pin of the barrel. Returns false if there are more faults than
/// `faults_before`.
bool ReadRod(const ConfigMap& cylinder_map, const Pin& barrel_pin, std::size_t faults_before,
             const std::set<std::string>& open_linkages, const MachineModel& model,
             Cylinder* cylinder) {
  const ConfigMap rod = cylinder_map.Map("rod");
  cylinder->rod = ReadOptionalMesh(rod);
  if (!rod.Has("linkage")) {
    const Pin pin = ReadPin(rod, model);
    if (FaultCount(cylinder_map) > faults_before) return false;
    cylinder->joint = JointBetween(cylinder_map, model, barrel_pin.link, pin.link);
    if (cylinder->joint < 0) return false;
    const Pin on_link = OnJointLink(model, cylinder->joint, pin);
    cylinder->rod_link = on_link.link;
    cylinder->rod_pin_m = on_link.p_m;
    return true;
  }
  const std::string name = rod.Text("linkage");
  std::vector<std::string> known;
  for (const FourBar& linkage : model.linkages) known.push_back(linkage.name);
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) {
    if (open_linkages.contains(name)) return false;
    rod.Fault("linkage", {FaultKind::kNoSuchName, fmt::format("there is no linkage '{}'{}", name,
                                                              DidYouMean(name, known))});
    return false;
  }
  cylinder->linkage = static_cast<int>(found - known.begin());
  const FourBar& linkage = model.linkages[cylinder->linkage];
  cylinder->rod_pin_m = rod.Vector3("pin_m", Any("m"), Vec3(linkage.rocker_m, 0, 0));
  if (FaultCount(cylinder_map) > faults_before) return false;
  cylinder->joint = linkage.joint;
  const Joint& joint = model.joints[linkage.joint];
  cylinder->rod_link = joint.parent;
  const Pin rocker_pin{joint.parent, linkage.rocker_pin_P_m};
  const std::set<int> a = JointsToRoot(model, barrel_pin.link);
  const std::set<int> b = JointsToRoot(model, rocker_pin.link);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const int between = static_cast<int>(j);
    if (a.contains(between) == b.contains(between)) continue;
    if (model.joints[j].type == JointType::kFixed) continue;
    cylinder_map.Fault("barrel",
                       fmt::format("joint '{}' moves between the barrel's link '{}' and the rocker "
                                   "of '{}'; need both on one",
                                   model.joints[j].name, model.links[barrel_pin.link].name, name));
    return false;
  }
  return !open_linkages.contains(name);
}

void ReadCylinder(const std::string& name, const ConfigMap& config,
                  const std::optional<ConfigMap>& hydraulics,
                  const std::set<std::string>& open_linkages, MachineModel* model) {
  const std::size_t faults_before = FaultCount(config);
  Cylinder cylinder;
  cylinder.name = name;
  const ConfigMap barrel = config.Map("barrel");
  cylinder.barrel = ReadOptionalMesh(barrel);
  const Pin pin = ReadPin(barrel, *model);
  cylinder.count =
      static_cast<int>(config.Integer("count", Between(1, kMostCylinders, "1"), cylinder.count));
  if (cylinder.count > 1) cylinder.spacing_m = config.Number("spacing_m", Positive("m"));
  if (config.Has("bore_m")) ReadPiston(config, hydraulics, &cylinder);
  if (!ReadRod(config, pin, faults_before, open_linkages, *model, &cylinder)) return;
  if (const int leader = LeaderOf(*model, cylinder.joint);
      cylinder.bore_m > 0 && leader != cylinder.joint) {
    config.Fault("bore_m",
                 fmt::format("joint '{}' follows '{}' and has no effort of its own; "
                             "leave the bore out, and the cylinder is only shown",
                             model->joints[cylinder.joint].name, model->joints[leader].name));
  }
  const Pin on_link = OnJointLink(*model, cylinder.joint, pin);
  cylinder.barrel_link = on_link.link;
  cylinder.barrel_pin_m = on_link.p_m;
  SetTravel(config, *model, &cylinder);
  model->cylinders.push_back(cylinder);
}

/// A joint with driving cylinders takes effort and oil volume from them alone.
void DriveByCylinders(const ConfigMap& config, MachineModel* model) {
  const auto joints = config.OptionalMap("joints");
  for (const Cylinder& cylinder : model->cylinders) {
    if (cylinder.bore_m == 0) continue;
    Joint& joint = model->joints[cylinder.joint];
    const double middle = 0.5 * (joint.lower_rad + joint.upper_rad);
    const EffortLimits limits = ReliefEffort(*model, cylinder.joint, middle);
    joint.max_effort_nm = 0.5 * (limits.positive_nm + limits.negative_nm);
    joint.displacement_m3prad =
        0.5 * (CylinderDisplacement_m3prad(*model, cylinder.joint, middle, +1) +
               CylinderDisplacement_m3prad(*model, cylinder.joint, middle, -1));
    const auto map = joints ? joints->OptionalMap(joint.name) : std::nullopt;
    if (!map) continue;
    for (const char* key :
         {"max_effort_nm", "max_effort_n", "displacement_m3prad", "displacement_m3pm"}) {
      if (!map->Has(key)) continue;
      map->Fault(key,
                 fmt::format("joint '{}' has it from bore, pressure and pins of cylinder '{}'; "
                             "need one of the two",
                             joint.name, cylinder.name));
    }
  }
}

void ReadPump(const std::string& name, const ConfigMap& config, MachineModel* model) {
  RequirePlainName(config, "", name);
  Pump pump{.name = name, .max_flow_m3ps = config.Number("max_flow_m3ps", Positive("m3/s"))};
  std::vector<std::string> known;
  for (const Joint& joint : model->joints) {
    if (joint.type != JointType::kFixed) known.push_back(joint.name);
  }
  for (const RunningGear& gear : model->ground_tools.gears) known.push_back(gear.name);
  for (const std::string& fed : config.Texts("feeds")) {
    const auto gear =
        std::find_if(model->ground_tools.gears.begin(), model->ground_tools.gears.end(),
                     [&](const RunningGear& g) { return g.name == fed; });
    if (gear != model->ground_tools.gears.end()) {
      pump.gears.push_back(static_cast<int>(gear - model->ground_tools.gears.begin()));
    } else if (std::find(known.begin(), known.end(), fed) != known.end()) {
      pump.joints.push_back(model->JointIndex(fed));
    } else {
      config.Fault("feeds", {FaultKind::kNoSuchName,
                             fmt::format("there is no joint that moves, track or wheel set '{}'{}",
                                         fed, DidYouMean(fed, known))});
    }
  }
  model->pumps.push_back(pump);
}

/// Reports consumers without displacement, which would take no oil from their pump.
void CheckFed(const ConfigMap& config, const MachineModel& model) {
  for (const Pump& pump : model.pumps) {
    std::vector<std::string> unknown;
    for (const int joint : pump.joints) {
      if (model.joints[joint].displacement_m3prad == 0) unknown.push_back(model.joints[joint].name);
    }
    for (const int gear : pump.gears) {
      if (model.gear_drives[gear].displacement_m3prad == 0) {
        unknown.push_back(model.ground_tools.gears[gear].name);
      }
    }
    if (unknown.empty()) continue;
    config.Fault("pumps", fmt::format("pump '{}' feeds {}, of which the oil taken is not known; "
                                      "need displacement_m3prad or a cylinder with a bore",
                                      pump.name, fmt::join(unknown, ", ")));
  }
}

}  // namespace

void ReadHydraulics(const ConfigMap& config, MachineModel* model) {
  const std::size_t faults_before = FaultCount(config);
  std::set<std::string> open_linkages;
  for (const auto& [name, map] : config.NamedMaps("linkages")) {
    if (!ReadLinkage(name, map, model)) open_linkages.insert(name);
  }
  const auto hydraulics = config.OptionalMap("hydraulics");
  for (const auto& [name, map] : config.NamedMaps("cylinders")) {
    RequirePlainName(map, "", name);
    ReadCylinder(name, map, hydraulics, open_linkages, model);
  }
  DriveByCylinders(config, model);
  for (const auto& [name, map] : config.NamedMaps("pumps")) ReadPump(name, map, model);
  if (FaultCount(config) == faults_before) CheckFed(config, *model);
}

}  // namespace tera
