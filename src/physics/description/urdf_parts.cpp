#include <console_bridge/console.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "core/config/config_beneath.h"
#include "core/config/listed_folder.h"
#include "core/config/plain_name.h"
#include "core/error.h"
#include "core/units.h"
#include "physics/description/machine_reading.h"
#include "physics/description/urdf_form.h"
#include "physics/description/urdf_lines.h"
#include "physics/description/urdf_shapes.h"
#include "physics/description/urdf_transmissions.h"

/// Reads links and joints of a URDF.
///
/// Model   Inertials; revolute, continuous, prismatic and fixed joints with their limits and
///         leaders (link_tree.h); visuals and collisions (urdf_shapes.h); drives
///         (urdf_transmissions.h). Damping and friction of a joint become the effects
///         viscous_friction and coulomb_friction. Effects given for the machine override them.
/// Omits   Safety controllers, calibration, textures.

namespace tera {
namespace {

namespace fs = std::filesystem;

/// Collects the messages of the URDF parser during its lifetime instead of printing them.
class ParserMessages : public console_bridge::OutputHandler {
 public:
  ParserMessages() { console_bridge::useOutputHandler(this); }
  ~ParserMessages() override { console_bridge::restorePreviousOutputHandler(); }
  void log(const std::string& text, console_bridge::LogLevel, const char*, int) override {
    if (!text_.empty()) text_ += "; ";
    text_ += text;
    std::replace(text_.begin(), text_.end(), '\n', ' ');
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Makes names of links or joints usable in CSV headers and paths, by replacing unsuitable
/// characters.
class PlainNames {
 public:
  PlainNames(std::string kind, std::vector<std::string>* changed)
      : kind_(std::move(kind)), changed_(*changed) {}

  /// Plain name of a part. Two parts with the same plain name are a fault.
  std::string Take(const std::string& name, const PartPlace& place) {
    const std::string plain = MadePlain(name);
    if (!IsPlainNameWithPoints(plain)) {
      place.Fault("name",
                  {FaultKind::kMalformed,
                   fmt::format("need letters, digits, '_', '-' and points inside, at most {}",
                               kLongestName)});
    }
    const auto [first, is_new] = taken_.emplace(plain, name);
    if (!is_new) {
      place.Fault("name", fmt::format("{} '{}' has the name '{}' as well, without signs that files "
                                      "cannot have; rename one",
                                      kind_, first->second, plain));
    }
    if (plain != name) changed_.push_back(fmt::format("'{}' is {}", name, plain));
    return plain;
  }

 private:
  std::string kind_;
  std::vector<std::string>& changed_;
  std::map<std::string, std::string> taken_;  ///< original names by plain name
};

Link ToLink(const urdf::Link& in, const PartPlace& place, UrdfMeshes* meshes) {
  Link link;
  if (in.inertial) {
    const Pose X_BI = PoseOf(in.inertial->origin);
    const urdf::Inertial& i = *in.inertial;
    Mat3 inertia_I;
    inertia_I << i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz;
    link.mass_kg = i.mass;
    link.com_B_m = X_BI.translation();
    link.inertia_B_kgm2 = X_BI.linear() * inertia_I * X_BI.linear().transpose();
  }
  AddUrdfShapes(in, place, meshes, &link);
  return link;
}

/// Converts a joint. Sets `known` to false if its type is unknown.
Joint ToJoint(const urdf::Joint& in, const PartPlace& place, bool* known) {
  Joint joint;
  joint.X_PJ = PoseOf(in.parent_to_joint_origin_transform);
  switch (in.type) {
    case urdf::Joint::REVOLUTE:
      joint.type = JointType::kRevolute;
      break;
    case urdf::Joint::CONTINUOUS:
      joint.type = JointType::kContinuous;
      break;
    case urdf::Joint::PRISMATIC:
      joint.type = JointType::kPrismatic;
      break;
    case urdf::Joint::FIXED:
      return joint;
    default:
      place.Fault("type",
                  {FaultKind::kNoSuchName, "need fixed, revolute, continuous or prismatic"});
      *known = false;
      return joint;
  }
  joint.axis_J = Vec3(in.axis.x, in.axis.y, in.axis.z);
  if (joint.axis_J.norm() > 0) {
    joint.axis_J.normalize();
  } else {
    place.Fault("axis", {FaultKind::kOutOfRange,
                         "the axis has no direction; need a vector that is not zero"});
    joint.axis_J = Vec3::UnitZ();
  }
  if (in.mimic) joint.following = {.ratio = in.mimic->multiplier, .offset = in.mimic->offset};
  if (in.limits) {
    joint.max_rate_positive_radps = joint.max_rate_negative_radps = in.limits->velocity;
    joint.max_effort_nm = in.limits->effort;
    if (joint.type != JointType::kContinuous) {
      joint.lower_rad = in.limits->lower;
      joint.upper_rad = in.limits->upper;
    }
  }
  if (joint.lower_rad > joint.upper_rad) {
    place.Fault("limit", fmt::format("lower limit {} is above upper limit {}", joint.lower_rad,
                                     joint.upper_rad));
    std::swap(joint.lower_rad, joint.upper_rad);
  }
  joint.initial_rad = joint.type == JointType::kContinuous
                          ? 0.0
                          : std::clamp(0.0, joint.lower_rad, joint.upper_rad);
  return joint;
}

/// Adds the friction of `in` to `effects`, in N m s/rad and N m, or N s/m and N for prismatic
/// joints.
void AddFriction(const urdf::Joint& in, const std::string& joint, const PartPlace& place,
                 std::vector<GivenNumber>* effects) {
  if (in.type == urdf::Joint::FIXED || !in.dynamics) return;
  const auto add = [&](std::string_view key, double value, const std::string& mechanism,
                       const std::string& parameter) {
    if (!std::isfinite(value) || value < 0) {
      place.Fault("dynamics",
                  {FaultKind::kOutOfRange, fmt::format("{} is {}; need 0 or more", key, value)});
    } else if (value > 0) {
      effects->push_back({{"effects", joint, mechanism, parameter}, value});
    }
  };
  add("damping", in.dynamics->damping, "viscous_friction", "coefficient_nmsprad");
  add("friction", in.dynamics->friction, "coulomb_friction", "effort_nm");
}

/// Overrides values of the URDF by the TERA keys of `links:` and `joints:`.
void LayOver(const ConfigMap& config, MachineParts* parts) {
  for (const auto& [name, map] : config.NamedMaps("links")) {
    const auto part =
        std::find_if(parts->links.begin(), parts->links.end(),
                     [&name = name](const LinkPart& p) { return p.link.name == name; });
    if (part == parts->links.end()) {
      map.Fault("", {FaultKind::kNoSuchName, fmt::format("the URDF has no link '{}'", name)});
    } else {
      part->link.label = ReadLabel(map, part->link.label);
    }
  }
  for (const auto& [name, map] : config.NamedMaps("joints")) {
    const auto part =
        std::find_if(parts->joints.begin(), parts->joints.end(),
                     [&name = name](const JointPart& p) { return p.joint.name == name; });
    if (part == parts->joints.end()) {
      map.Fault("", {FaultKind::kNoSuchName, fmt::format("the URDF has no joint '{}'", name)});
    } else if (part->leader.empty()) {
      ReadJointActuation(map, &part->joint);
    } else {
      map.Fault("", fmt::format("joint '{}' follows '{}', whose rate, effort and start move both; "
                                "say them of that one",
                                name, part->leader));
      for (const std::string& key : map.Keys()) map.Has(key);
    }
  }
}

std::string WholeText(const fs::path& file) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Counts omitted textures, safety controllers and extensions: "1 texture, 2 <gazebo>".
std::string LeftOutOf(const urdf::ModelInterface& model, const tinyxml2::XMLElement& robot) {
  int textures = 0, safe = 0;
  for (const auto& [name, link] : model.links_) {
    for (const auto& visual : link->visual_array) {
      textures += visual->material && !visual->material->texture_filename.empty();
    }
  }
  for (const auto& [name, joint] : model.joints_) safe += joint->safety != nullptr;
  std::vector<std::string> parts;
  const auto add = [&](int count, const std::string& one, const std::string& several) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, count == 1 ? one : several));
  };
  add(textures, "texture", "textures");
  add(safe, "safety controller", "safety controllers");
  for (const std::string& unread : UnreadElements(robot)) parts.push_back(unread);
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Folders of `packages:`, by package name.
std::map<std::string, fs::path> ReadPackages(const ConfigMap& config) {
  std::map<std::string, fs::path> folders;
  if (const auto packages = config.OptionalMap("packages")) {
    for (const std::string& name : packages->Keys()) folders[name] = Folder(*packages, name);
  }
  return folders;
}

/// Links and joints of a URDF with remarks, without the TERA keys.
MachineParts PartsOf(const urdf::ModelInterface& model, const UrdfLines& lines,
                     const ConfigMap& config, UrdfMeshes* meshes) {
  const std::string file = meshes->urdf.filename().string();
  MachineParts parts;
  std::vector<std::string> renamed;
  PlainNames links("link", &renamed), joints("joint", &renamed);
  for (const auto& [name, in] : model.links_) {
    const PartPlace place{config, lines.PlaceOf("link", name)};
    Link link = ToLink(*in, place, meshes);
    link.name = links.Take(name, place);
    parts.links.push_back({std::move(link), place});
  }
  std::vector<GivenNumber> effects;
  for (const auto& [name, in] : model.joints_) {
    const PartPlace place{config, lines.PlaceOf("joint", name)};
    Joint joint = ToJoint(*in, place, &parts.whole);
    joint.name = joints.Take(name, place);
    AddFriction(*in, joint.name, place, &effects);
    const std::string leader = joint.following ? MadePlain(in->mimic->joint_name) : "";
    parts.joints.push_back({std::move(joint), MadePlain(in->parent_link_name),
                            MadePlain(in->child_link_name), place, leader});
  }
  if (!effects.empty()) LayBeneath(config, file, effects);
  if (!renamed.empty()) {
    parts.remarks.push_back(
        fmt::format("{}: names get signs that files can have: {}", file, fmt::join(renamed, ", ")));
  }
  if (!meshes->left_out.empty()) {
    parts.remarks.push_back(fmt::format("{}: meshes left out that are not there: {}", file,
                                        fmt::join(meshes->left_out, ", ")));
  }
  return parts;
}

/// Finds rotations of more than a full turn below `element`, with their lines: "45 (line 12)".
void FindLongTurns(const tinyxml2::XMLElement& element, std::vector<std::string>* found) {
  if (const char* rpy = element.Attribute("rpy")) {
    std::istringstream angles(rpy);
    for (double angle_rad = 0; angles >> angle_rad;) {
      if (std::abs(angle_rad) <= 2 * kPi) continue;
      found->push_back(fmt::format("{:g} (line {})", angle_rad, element.GetLineNum()));
    }
  }
  for (const auto* e = element.FirstChildElement(); e; e = e->NextSiblingElement()) {
    FindLongTurns(*e, found);
  }
}

}  // namespace

std::optional<MachineParts> ReadUrdfParts(const ConfigMap& config, AbsentMeshes absent) {
  for (const char* key : {"links", "joints", "actuators", "packages"}) config.Has(key);
  const fs::path file = config.File("urdf");
  if (file.empty()) return std::nullopt;
  const std::string text = WholeText(file), shown = file.filename().string();
  tinyxml2::XMLDocument document;
  if (!ParseXml(config, file, text, &document) || !RequireUrdf(config, shown, document)) {
    return std::nullopt;
  }
  const tinyxml2::XMLElement& robot = *document.RootElement();
  const ParserMessages messages;
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  if (!model) {
    config.Fault("urdf",
                 {FaultKind::kMalformed,
                  fmt::format("'{}' is not a valid URDF: {}; correct it (check_urdf tells more)",
                              shown, messages.text())});
    return std::nullopt;
  }
  UrdfMeshes meshes{file, ReadPackages(config), absent};
  MachineParts parts = PartsOf(*model, LinesOf(robot, file), config, &meshes);
  if (const std::string left_out = LeftOutOf(*model, robot); !left_out.empty()) {
    parts.remarks.push_back(fmt::format("{}: {} left out", shown, left_out));
  }
  std::vector<std::string> turns;
  FindLongTurns(robot, &turns);
  if (!turns.empty()) {
    parts.remarks.push_back(fmt::format(
        "warning: {}: rotations beyond a turn, rpy of {}: in degrees? URDF takes radians", shown,
        fmt::join(turns, ", ")));
  }
  ReadUrdfDrives(config, file, robot, &parts);
  LayOver(config, &parts);
  CheckDriven(parts);
  return parts;
}

}  // namespace tera
