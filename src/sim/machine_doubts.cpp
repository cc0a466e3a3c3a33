#include "sim/machine_doubts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/units.h"

namespace tera {
namespace {

using Box = Eigen::AlignedBox3d;

/// About the length of the boom of the largest draglines.
constexpr double kLongestLink_m = 100;
constexpr double kMillimetre_m = 1e-3;
/// Limit on density. The densest metal, osmium, has 22.6 t/m3.
constexpr double kAir_kgpm3 = 1.2, kDensest_kgpm3 = 25000;
/// Smallest plausible radius of gyration, as a share of half the diagonal. A needle has 0.58, a
/// ball 0.37.
constexpr double kPointGyration = 0.01;
constexpr double kTurn_rad = 2 * kPi;

Box BoxIn(const Box& box, const Pose& X_AB) {
  Box moved;
  if (box.isEmpty()) return moved;
  for (int corner = 0; corner < 8; ++corner) {
    moved.extend(X_AB * box.corner(static_cast<Box::CornerType>(corner)));
  }
  return moved;
}

const SceneInstance* InstanceOf(const SceneModel& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.instances, name, &SceneInstance::name);
  return found == scene.instances.end() ? nullptr : &*found;
}

/// Bounding box of a link's visuals; empty without visuals.
Box ShownBox(const ScenarioMachine& machine, const Link& link, const SceneModel& scene) {
  if (link.visuals.empty()) return {};
  const SceneInstance* shown = InstanceOf(scene, machine.placement.name + "/" + link.name);
  return shown == nullptr ? Box() : Box(shown->box_min_B_m, shown->box_max_B_m);
}

/// Bounding box of a link with all its shapes and tools, in the link's frame.
Box BoxOf(const ScenarioMachine& machine, std::size_t index, const SceneModel& scene) {
  const MachineModel& model = machine.placement.model;
  const Link& link = model.links[index];
  const int number = static_cast<int>(index);
  Box box = ShownBox(machine, link, scene);
  for (const CollisionBox& part : link.collision) {
    box.extend(BoxIn(Box(-0.5 * part.size_m, 0.5 * part.size_m), part.X_BG));
  }
  for (const RunningGear& gear : model.ground_tools.gears) {
    if (gear.link != number) continue;
    for (const ContactPatch& patch : gear.patches) {
      const Vec3 half_m(0, 0.5 * patch.width_m, 0);
      box.extend(patch.p_B_m - half_m).extend(patch.p_B_m + half_m);
    }
  }
  for (const Shovel& shovel : model.ground_tools.shovels) {
    if (shovel.link != number) continue;
    for (const Vec2& p : shovel.profile_B_m) {
      for (const double side : {-0.5, 0.5}) {
        box.extend(Vec3(p.x(), side * shovel.width_m, p.y()));
      }
    }
  }
  for (const auto& point : model.ground_tools.hull_points) {
    if (point.link == number) box.extend(point.p_B_m);
  }
  return box;
}

Vec3 SizeOf(const Box& box) { return box.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(box.sizes()); }

std::string Shown(const Vec3& size_m) {
  return fmt::format("{:.4g} x {:.4g} x {:.4g} m", size_m.x(), size_m.y(), size_m.z());
}

/// Several links that are fixed together, in the frame of the first one.
struct RigidBody {
  std::string name;
  double mass_kg = 0;
  Vec3 com_m = Vec3::Zero();
  Mat3 inertia_kgm2 = Mat3::Zero();  ///< about the centre of mass
  Box box;

  void Add(const Link& link, const Box& link_box, const Pose& X_CB) {
    box.extend(BoxIn(link_box, X_CB));
    if (link.mass_kg == 0) return;
    const Vec3 apart_m = X_CB * link.com_B_m - com_m;
    const double total_kg = mass_kg + link.mass_kg;
    inertia_kgm2 += X_CB.linear() * link.inertia_B_kgm2 * X_CB.linear().transpose() +
                    mass_kg * link.mass_kg / total_kg *
                        (apart_m.squaredNorm() * Mat3::Identity() - apart_m * apart_m.transpose());
    com_m += link.mass_kg / total_kg * apart_m;
    mass_kg = total_kg;
  }
};

std::vector<RigidBody> BodiesOf(const MachineModel& model, const std::vector<Box>& boxes) {
  std::vector<RigidBody> bodies;
  std::vector<std::size_t> body_of(model.links.size(), 0);
  std::vector<Pose> X_CB(model.links.size(), Pose::Identity());
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Joint* joint = i == 0 ? nullptr : &model.joints[i - 1];
    if (joint != nullptr && joint->type == JointType::kFixed) {
      body_of[i] = body_of[joint->parent];
      X_CB[i] = X_CB[joint->parent] * joint->X_PJ;
    } else {
      body_of[i] = bodies.size();
      bodies.push_back({.name = model.links[i].name});
    }
    bodies[body_of[i]].Add(model.links[i], boxes[i], X_CB[i]);
  }
  return bodies;
}

std::optional<std::string> DoubtOfDensity(const std::string& link, double mass_kg, const Box& box) {
  // A flat mesh has no volume.
  const double volume_m3 = box.isEmpty() ? 0 : box.volume();
  if (volume_m3 <= 0 || mass_kg <= kDensest_kgpm3 * volume_m3) return std::nullopt;
  return fmt::format(", link {}: {:.3g} kg in {}, denser than any metal: are its meshes too small?",
                     link, mass_kg, Shown(SizeOf(box)));
}

std::optional<std::string> DoubtOfInertia(const RigidBody& body) {
  if (body.mass_kg <= 0 || body.box.isEmpty()) return std::nullopt;
  const double moment_kgm2 =
      Eigen::SelfAdjointEigenSolver<Mat3>(body.inertia_kgm2, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .maxCoeff();
  const double gyration_m = std::sqrt(moment_kgm2 / body.mass_kg);
  const double half_m = 0.5 * body.box.diagonal().norm();
  if (gyration_m > half_m) {
    return fmt::format(
        ", link {}: {:.3g} kg, and its inertia (radius of gyration {:.3g} m) is that of a body "
        "larger than its meshes ({}): placeholders?",
        body.name, body.mass_kg, gyration_m, Shown(SizeOf(body.box)));
  }
  if (auto dense = DoubtOfDensity(body.name, body.mass_kg, body.box)) return dense;
  const double beside_m = body.box.exteriorDistance(body.com_m);
  if (beside_m > 2 * half_m) {
    return fmt::format(
        ", link {}: its centre of mass lies {:.3g} m outside its meshes ({}): in mm, or in another "
        "frame?",
        body.name, beside_m, Shown(SizeOf(body.box)));
  }
  if (gyration_m < kPointGyration * half_m) {
    return fmt::format(
        ", link {}: {:.3g} kg, and its inertia (radius of gyration {:.3g} m) is that of a point "
        "inside its meshes ({}): placeholder?",
        body.name, body.mass_kg, gyration_m, Shown(SizeOf(body.box)));
  }
  return std::nullopt;
}

/// Warns of limits that look like degrees, and of limits that lock a joint.
std::optional<std::string> DoubtOfLimits(const Joint& joint) {
  const bool turns = joint.type == JointType::kRevolute;
  if ((!turns && joint.type != JointType::kPrismatic) || joint.following) return std::nullopt;
  const double lower = joint.lower_rad, upper = joint.upper_rad;
  const bool is_driven = joint.max_effort_nm > 0 &&
                         std::max(joint.max_rate_positive_radps, joint.max_rate_negative_radps) > 0;
  if (lower == upper && !is_driven) {
    return fmt::format(
        ", joint {} cannot move: its limits are both {:.4g} {}, and its velocity or effort is 0: "
        "left by the exporter?",
        joint.name, lower, turns ? "rad" : "m");
  }
  if (!turns || std::max(-lower, upper) <= kTurn_rad) return std::nullopt;
  return fmt::format(
      ", joint {} has limits of {:.4g} to {:.4g} rad ({:.0f} turns): in degrees? URDF takes "
      "radians",
      joint.name, lower, upper, (upper - lower) / kTurn_rad);
}

/// The mesh that makes a link too long, or null.
const Visual* LongMesh(const ScenarioMachine& machine, const Link& link, const SceneModel& scene) {
  const SceneInstance* shown = InstanceOf(scene, machine.placement.name + "/" + link.name);
  if (shown == nullptr) return nullptr;
  std::size_t visual = 0;
  for (const SceneNode& node : scene.nodes) {
    if (&scene.instances[node.instance] != shown || node.body != shown->body) continue;
    if (visual == link.visuals.size()) break;
    const Visual& its = link.visuals[visual++];
    Box box;
    for (const MeshPart& part : scene.meshes[node.mesh].parts) {
      for (const Eigen::Vector3f& p : part.positions_m) box.extend(node.scale * p.cast<double>());
    }
    if (!its.solid && SizeOf(box).maxCoeff() > kLongestLink_m) return &its;
  }
  return nullptr;
}

std::optional<std::string> DoubtOfLength(const ScenarioMachine& machine, const Link& link,
                                         const Box& box, const SceneModel& scene) {
  const double length_m = SizeOf(box).maxCoeff();
  if (length_m <= kLongestLink_m) return std::nullopt;
  const std::string found = fmt::format(", link {} is {:.4g} m long: ", link.name, length_m);
  const Visual* visual = LongMesh(machine, link, scene);
  if (visual == nullptr) return found + "is it in mm? need metres";
  const double scale = std::abs(visual->scale) * kMillimetre_m;
  return found +
         fmt::format("is {} in mm? scale: {:.4g} (in a URDF scale=\"{:.4g} {:.4g} {:.4g}\")",
                     visual->mesh.filename().string(), scale, scale, scale, scale);
}

std::optional<std::string> DoubtOfTotalMass(const MachineModel& model,
                                            const std::vector<double>& q_rad,
                                            const std::vector<Box>& boxes) {
  const double mass_kg = model.TotalMass_kg();
  const std::vector<Pose> X_WL = ForwardKinematics(model, Pose::Identity(), q_rad);
  Box whole;
  for (std::size_t i = 0; i < boxes.size(); ++i) whole.extend(BoxIn(boxes[i], X_WL[i]));
  if (mass_kg == 0 || whole.isEmpty() || mass_kg > kAir_kgpm3 * whole.volume()) return std::nullopt;
  return fmt::format(": {:.3g} kg in all, less than the air in {}: placeholders?", mass_kg,
                     Shown(SizeOf(whole)));
}

std::optional<std::string> DoubtOfGround(const MachineModel& model) {
  if (model.fixed_base || model.BearsOnGround()) return std::nullopt;
  std::vector<std::string> endless;
  for (const Joint& joint : model.joints) {
    if (joint.type == JointType::kContinuous) endless.push_back(joint.name);
  }
  std::string doubt =
      " touches nothing and will fall: no tracks, wheels or hull_points; give it these, or "
      "fixed_base: true";
  if (endless.size() > 1) {
    doubt += fmt::format(" (are {} wheels? docs/reference/machines.md, Wheels of a URDF)",
                         fmt::join(endless, ", "));
  }
  return doubt;
}

std::vector<Box> BoxesOf(const ScenarioMachine& machine, const SceneModel& scene) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < machine.placement.model.links.size(); ++i) {
    boxes.push_back(BoxOf(machine, i, scene));
  }
  return boxes;
}

}  // namespace

std::vector<LinkSize> SizesOf(const ScenarioMachine& machine, const SceneModel& scene) {
  const std::vector<Link>& links = machine.placement.model.links;
  const std::vector<Box> boxes = BoxesOf(machine, scene);
  std::vector<LinkSize> sizes;
  for (std::size_t i = 0; i < links.size(); ++i) {
    sizes.push_back({links[i].name, links[i].mass_kg, SizeOf(boxes[i])});
  }
  return sizes;
}

std::vector<std::string> DoubtsOf(const ScenarioMachine& machine, const SceneModel& scene) {
  const MachineModel& model = machine.placement.model;
  const std::vector<Box> boxes = BoxesOf(machine, scene);
  std::vector<std::string> doubts;
  const auto add = [&](const std::optional<std::string>& doubt) {
    if (!doubt) return;
    const std::string whole = machine.placement.name + *doubt;
    if (std::ranges::find(doubts, whole) == doubts.end()) doubts.push_back(whole);
  };
  add(DoubtOfGround(model));
  const std::size_t before = doubts.size();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    add(DoubtOfLength(machine, model.links[i], boxes[i], scene));
  }
  if (doubts.size() > before) return doubts;  // the other checks need plausible sizes
  for (const RigidBody& body : BodiesOf(model, boxes)) add(DoubtOfInertia(body));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Link& link = model.links[i];
    if (!link.visuals.empty()) add(DoubtOfDensity(link.name, link.mass_kg, boxes[i]));
  }
  const std::size_t before_limits = doubts.size();
  for (const Joint& joint : model.joints) add(DoubtOfLimits(joint));
  if (doubts.size() == before_limits) {
    for (std::string& doubt : DrivesInDoubt(machine.placement)) doubts.push_back(std::move(doubt));
  }
  add(DoubtOfTotalMass(model, machine.placement.q_rad, boxes));
  return doubts;
}

}  // namespace tera
