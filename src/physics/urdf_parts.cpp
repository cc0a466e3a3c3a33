#include <console_bridge/console.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/plain_name.h"
#include "physics/machine_reading.h"
#include "physics/urdf_left_out.h"
#include "physics/urdf_transmissions.h"

/// URDF to links and joints.
///
/// Model   inertials, revolute, continuous, prismatic and fixed joints with their limits, mesh
///         visuals, boxes for collision (spheres and cylinders by the box around them), drives
///         (urdf_transmissions.h).
/// Omits   collision meshes, visuals that are not meshes, materials, mimic, friction, damping.

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

Pose ToPose(const urdf::Pose& pose) {
  const urdf::Rotation& q = pose.rotation;
  return MakePose(Vec3(pose.position.x, pose.position.y, pose.position.z),
                  Quat(q.w, q.x, q.y, q.z).normalized().toRotationMatrix());
}

/// Path of a mesh: relative to the URDF; `package://name/path` looks for `path` (with or without
/// the package's name) in the folders above the URDF.
std::optional<fs::path> FindMesh(const std::string& text, const fs::path& urdf) {
  constexpr std::string_view kPackage = "package://", kFile = "file://";
  const fs::path folder = urdf.parent_path();
  if (text.starts_with(kFile)) return fs::path(text.substr(kFile.size()));
  if (!text.starts_with(kPackage)) return folder / text;
  const fs::path with_package = text.substr(kPackage.size());
  const fs::path inside = with_package.lexically_relative(*with_package.begin());
  for (fs::path up = fs::absolute(folder); up.has_relative_path(); up = up.parent_path()) {
    for (const fs::path& tail : {with_package, inside}) {
      if (fs::is_regular_file(up / tail)) return up / tail;
    }
  }
  return std::nullopt;
}

std::optional<Vec3> BoundingBox(const urdf::Geometry& geometry) {
  if (const auto* box = dynamic_cast<const urdf::Box*>(&geometry)) {
    return Vec3(box->dim.x, box->dim.y, box->dim.z);
  }
  if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(&geometry)) {
    return Vec3::Constant(2 * sphere->radius);
  }
  if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(&geometry)) {
    return Vec3(2 * cylinder->radius, 2 * cylinder->radius, cylinder->length);
  }
  return std::nullopt;
}

void AddVisuals(const urdf::Link& in, const fs::path& file, const PartPlace& place, Link* link) {
  for (const auto& visual : in.visual_array) {
    const auto* mesh = dynamic_cast<const urdf::Mesh*>(visual->geometry.get());
    if (!mesh) continue;
    const auto path = FindMesh(mesh->filename, file);
    if (!path || !fs::is_regular_file(*path)) {
      place.Fault("visual", fmt::format("mesh '{}' does not exist; correct the path (relative to "
                                        "the URDF, or package:// below a folder above it)",
                                        mesh->filename));
      continue;
    }
    if (mesh->scale.x != mesh->scale.y || mesh->scale.x != mesh->scale.z || mesh->scale.x <= 0) {
      place.Fault("visual",
                  fmt::format("mesh '{}' is scaled by {} {} {}; need one positive factor",
                              mesh->filename, mesh->scale.x, mesh->scale.y, mesh->scale.z));
      continue;
    }
    place.config.AlsoReads(path->lexically_normal());
    link->visuals.push_back({.mesh = path->lexically_normal(),
                             .place = place.config.Place("urdf") + ": " + place.part,
                             .X_BG = ToPose(visual->origin),
                             .scale = mesh->scale.x});
  }
}

Link ToLink(const urdf::Link& in, const fs::path& file, const PartPlace& place) {
  Link link;
  link.name = in.name;
  if (in.inertial) {
    const Pose X_BI = ToPose(in.inertial->origin);
    const urdf::Inertial& i = *in.inertial;
    Mat3 inertia_I;
    inertia_I << i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz;
    link.mass_kg = i.mass;
    link.com_B_m = X_BI.translation();
    link.inertia_B_kgm2 = X_BI.linear() * inertia_I * X_BI.linear().transpose();
  }
  for (const auto& collision : in.collision_array) {
    if (const auto size_m = BoundingBox(*collision->geometry)) {
      link.collision.push_back({.X_BG = ToPose(collision->origin), .size_m = *size_m});
    }
  }
  AddVisuals(in, file, place, &link);
  return link;
}

Joint ToJoint(const urdf::Joint& in, const PartPlace& place) {
  Joint joint;
  joint.name = in.name;
  joint.X_PJ = ToPose(in.parent_to_joint_origin_transform);
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

/// Lays the TERA keys of `links:` and `joints:` over what the URDF says.
void LayOver(const ConfigMap& config, MachineParts* parts) {
  for (const auto& [name, map] : config.NamedMaps("links")) {
    const auto part = std::find_if(parts->links.begin(), parts->links.end(),
                                   [&](const LinkPart& p) { return p.link.name == name; });
    if (part == parts->links.end()) {
      map.Fault("", fmt::format("the URDF has no link '{}'", name));
    } else {
      part->link.label = ReadLabel(map, part->link.label);
    }
  }
  for (const auto& [name, map] : config.NamedMaps("joints")) {
    const auto part = std::find_if(parts->joints.begin(), parts->joints.end(),
                                   [&](const JointPart& p) { return p.joint.name == name; });
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

std::string Counted(int count, const std::string& one, const std::string& several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}

}  // namespace

std::string LeftOutOf(const fs::path& urdf) {
  const ParserMessages messages;
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(WholeText(urdf));
  if (!model) return "";
  int visuals = 0, collisions = 0;
  for (const auto& [name, link] : model->links_) {
    for (const auto& visual : link->visual_array) {
      visuals += visual->geometry && visual->geometry->type != urdf::Geometry::MESH;
    }
    for (const auto& collision : link->collision_array) {
      collisions += collision->geometry && collision->geometry->type == urdf::Geometry::MESH;
    }
  }
  std::vector<std::string> parts;
  if (visuals > 0) {
    parts.push_back(Counted(visuals, "visual that is no mesh", "visuals that are no meshes"));
  }
  if (collisions > 0) parts.push_back(Counted(collisions, "collision mesh", "collision meshes"));
  return fmt::format("{}", fmt::join(parts, " and "));
}

MachineParts ReadUrdfParts(const ConfigMap& config) {
  MachineParts parts;
  const fs::path file = config.File("urdf");
  if (file.empty()) return parts;
  const std::string text = WholeText(file);
  const ParserMessages messages;
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  if (!model) {
    config.Fault("urdf",
                 fmt::format("'{}' is not a valid URDF: {}; correct it (check_urdf tells more)",
                             file.filename().string(), messages.text()));
    return parts;
  }
  for (const auto& [name, link] : model->links_) {
    const PartPlace place{config, fmt::format("link '{}' of {}", name, file.filename().string())};
    RequireName(name, place);
    parts.links.push_back({ToLink(*link, file, place), place});
  }
  for (const auto& [name, joint] : model->joints_) {
    const PartPlace place{config, fmt::format("joint '{}' of {}", name, file.filename().string())};
    RequireName(name, place);
    parts.joints.push_back(
        {ToJoint(*joint, place), joint->parent_link_name, joint->child_link_name, place});
  }
  ReadUrdfDrives(config, file, text, &parts);
  LayOver(config, &parts);
  CheckDriven(parts);
  return parts;
}

}  // namespace tera
