#include <console_bridge/console.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/config/config_beneath.h"
#include "core/config/plain_name.h"
#include "core/error.h"
#include "physics/description/machine_reading.h"
#include "physics/description/urdf_left_out.h"
#include "physics/description/urdf_lines.h"
#include "physics/description/urdf_shapes.h"
#include "physics/description/urdf_transmissions.h"

/// URDF to links and joints.
///
/// Model   inertials, revolute, continuous, prismatic and fixed joints with their limits, visuals
///         and collisions (urdf_shapes.h), drives (urdf_transmissions.h).
///         A joint's damping and friction are effects of the machine, viscous_friction and
///         coulomb_friction, below those that it is given.
/// Omits   safety controllers, calibration, textures; joints that mimic others are faults.

namespace tera {
namespace {

namespace fs = std::filesystem;

/// Collects what the URDF parser says while it lives, instead of letting it print.
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

/// Names stand in headers of CSV files.
void RequireName(const std::string& name, const PartPlace& place) {
  if (IsPlainNameWithPoints(name)) return;
  place.Fault("name", fmt::format("need letters, digits, '_', '-' and points inside, at most {}",
                                  kLongestName));
}

Link ToLink(const urdf::Link& in, const fs::path& file, const PartPlace& place) {
  Link link;
  link.name = in.name;
  if (in.inertial) {
    const Pose X_BI = PoseOf(in.inertial->origin);
    const urdf::Inertial& i = *in.inertial;
    Mat3 inertia_I;
    inertia_I << i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz;
    link.mass_kg = i.mass;
    link.com_B_m = X_BI.translation();
    link.inertia_B_kgm2 = X_BI.linear() * inertia_I * X_BI.linear().transpose();
  }
  AddUrdfShapes(in, file, place, &link);
  return link;
}

/// `known` turns false where the joint is of a kind that is not.
Joint ToJoint(const urdf::Joint& in, const PartPlace& place, bool* known) {
  Joint joint;
  joint.name = in.name;
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
      place.Fault("type", "need fixed, revolute, continuous or prismatic");
      *known = false;
      return joint;
  }
  joint.axis_J = Vec3(in.axis.x, in.axis.y, in.axis.z);
  if (joint.axis_J.norm() > 0) {
    joint.axis_J.normalize();
  } else {
    place.Fault("axis", "the axis has no direction; need a vector that is not zero");
    joint.axis_J = Vec3::UnitZ();
  }
  if (in.mimic) place.Fault("mimic", "joints that follow others are not supported; remove it");
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

/// Adds what `in` says of friction to `effects`, in their units: N m s/rad and N m, of a joint that
/// slides N s/m and N.
void AddFriction(const urdf::Joint& in, const PartPlace& place, std::vector<GivenNumber>* effects) {
  if (in.type == urdf::Joint::FIXED || !in.dynamics) return;
  const auto add = [&](std::string_view key, double value, const std::string& mechanism,
                       const std::string& parameter) {
    if (!std::isfinite(value) || value < 0) {
      place.Fault("dynamics", fmt::format("{} is {}; need 0 or more", key, value));
    } else if (value > 0) {
      effects->push_back({{"effects", in.name, mechanism, parameter}, value});
    }
  };
  add("damping", in.dynamics->damping, "viscous_friction", "coefficient_nmsprad");
  add("friction", in.dynamics->friction, "coulomb_friction", "effort_nm");
}

/// Lays the TERA keys of `links:` and `joints:` over what the URDF says.
void LayOver(const ConfigMap& config, MachineParts* parts) {
  for (const auto& [name, map] : config.NamedMaps("links")) {
    const auto part =
        std::find_if(parts->links.begin(), parts->links.end(),
                     [&name = name](const LinkPart& p) { return p.link.name == name; });
    if (part == parts->links.end()) {
      map.Fault("", fmt::format("the URDF has no link '{}'", name));
    } else {
      part->link.label = ReadLabel(map, part->link.label);
    }
  }
  for (const auto& [name, map] : config.NamedMaps("joints")) {
    const auto part =
        std::find_if(parts->joints.begin(), parts->joints.end(),
                     [&name = name](const JointPart& p) { return p.joint.name == name; });
    if (part == parts->joints.end()) {
      map.Fault("", fmt::format("the URDF has no joint '{}'", name));
    } else {
      ReadJointActuation(map, &part->joint);
    }
  }
}

std::string WholeText(const fs::path& file) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace

std::string LeftOutOf(const fs::path& urdf) {
  const ParserMessages messages;
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(WholeText(urdf));
  if (!model) return "";
  int textures = 0, safe = 0;
  for (const auto& [name, link] : model->links_) {
    for (const auto& visual : link->visual_array) {
      textures += visual->material && !visual->material->texture_filename.empty();
    }
  }
  for (const auto& [name, joint] : model->joints_) {
    safe += joint->safety != nullptr;
  }
  std::vector<std::string> parts;
  const auto add = [&](int count, const std::string& one, const std::string& several) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, count == 1 ? one : several));
  };
  add(textures, "texture", "textures");
  add(safe, "safety controller", "safety controllers");
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::optional<MachineParts> ReadUrdfParts(const ConfigMap& config) {
  for (const char* key : {"links", "joints", "actuators"}) config.Has(key);
  const fs::path file = config.File("urdf");
  if (file.empty()) return std::nullopt;
  const std::string text = WholeText(file);
  const std::optional<UrdfLines> lines = ReadUrdfLines(config, file, text);
  if (!lines) return std::nullopt;
  const ParserMessages messages;
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  if (!model) {
    config.Fault("urdf",
                 fmt::format("'{}' is not a valid URDF: {}; correct it (check_urdf tells more)",
                             file.filename().string(), messages.text()));
    return std::nullopt;
  }
  MachineParts parts;
  for (const auto& [name, link] : model->links_) {
    const PartPlace place{config, lines->PlaceOf("link", name)};
    RequireName(name, place);
    parts.links.push_back({ToLink(*link, file, place), place});
  }
  std::vector<GivenNumber> effects;
  for (const auto& [name, joint] : model->joints_) {
    const PartPlace place{config, lines->PlaceOf("joint", name)};
    AddFriction(*joint, place, &effects);
    RequireName(name, place);
    parts.joints.push_back({ToJoint(*joint, place, &parts.whole), joint->parent_link_name,
                            joint->child_link_name, place});
  }
  if (!effects.empty()) LayBeneath(config, file.filename().string(), effects);
  ReadUrdfDrives(config, file, text, &parts);
  LayOver(config, &parts);
  CheckDriven(parts);
  return parts;
}

}  // namespace tera
