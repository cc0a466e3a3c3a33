#include "sim/scene_assembly.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/error.h"
#include "core/units.h"
#include "physics/actuation/linkage.h"
#include "render/meshes/painted_parts.h"
#include "sim/machine_wear.h"
#include "sim/obstacle_bodies.h"

namespace tera {
namespace {

/// Frame at `origin` with x along `x_axis` and y as close to `y_hint` as possible.
Mat3 FrameFromX(const Vec3& x_axis, const Vec3& y_hint) {
  Mat3 R;
  R.col(0) = x_axis.normalized();
  R.col(2) = R.col(0).cross(y_hint).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

/// Pose on a closed path at arc length `s_m`: x along the path, z = x cross y of the link.
Pose OnPath(const std::vector<Vec3>& path_m, const std::vector<double>& arc_m, double s_m) {
  const double total_m = arc_m.back();
  s_m -= total_m * std::floor(s_m / total_m);
  const std::size_t i = std::min<std::size_t>(
      std::upper_bound(arc_m.begin(), arc_m.end(), s_m) - arc_m.begin() - 1, path_m.size() - 1);
  const Vec3& a = path_m[i];
  const Vec3& b = path_m[(i + 1) % path_m.size()];
  const double s = (s_m - arc_m[i]) / (arc_m[i + 1] - arc_m[i]);
  return MakePose((1 - s) * a + s * b, FrameFromX(b - a, Vec3::UnitY()));
}

void AppendLinkagePoses(const MachineModel& machine, const MachineState& now,
                        std::vector<Pose>* poses) {
  for (const FourBar& linkage : machine.linkages) {
    const Pose& X_WP = now.links[machine.joints[linkage.joint].parent].X_WB;
    const FourBarPose pose = PoseOf(machine, linkage, now.q_rad[linkage.joint]);
    poses->push_back(X_WP * pose.X_PR);
    poses->push_back(X_WP * pose.X_PC);
  }
}

/// Poses of barrel and rod of each cylinder. Each points from its pin to the other's pin.
void AppendCylinderPoses(const MachineModel& machine, const MachineState& now,
                         std::vector<Pose>* poses) {
  for (const Cylinder& cylinder : machine.cylinders) {
    const Joint& joint = machine.joints[cylinder.joint];
    const Pose& X_WP = now.links[joint.parent].X_WB;
    const CylinderPins pins = PinsOf(machine, cylinder, now.q_rad[cylinder.joint]);
    const Vec3 axis_P = joint.X_PJ.linear() * joint.axis_J;
    const Mat3 R_WC = FrameFromX(X_WP.linear() * (pins.rod_P_m - pins.barrel_P_m),
                                 now.links[cylinder.barrel_link].X_WB.linear().col(1));
    for (int k = 0; k < cylinder.count; ++k) {
      const Vec3 aside_m = (k - 0.5 * (cylinder.count - 1)) * cylinder.spacing_m * axis_P;
      poses->push_back(MakePose(X_WP * Vec3(pins.barrel_P_m + aside_m), R_WC));
      poses->push_back(MakePose(X_WP * Vec3(pins.rod_P_m + aside_m), R_WC));
    }
  }
}

std::vector<double> ArcLengths(const std::vector<Vec3>& path_m) {
  std::vector<double> arc_m = {0.0};
  for (std::size_t i = 0; i < path_m.size(); ++i) {
    arc_m.push_back(arc_m.back() + (path_m[(i + 1) % path_m.size()] - path_m[i]).norm());
  }
  return arc_m;
}

/// Adds the mesh or solid of `visual` and returns the index of its mesh.
int AddLooksOf(const Visual& visual, SceneModel* scene) {
  if (visual.solid) return AddSolid(*visual.solid, visual.paint.value_or(Paint()), scene);
  if (visual.paint) return AddPaintedMesh(visual.mesh, *visual.paint, scene);
  return scene->AddMesh(visual.mesh, visual.node);
}

/// Depth of a key point below the visible surface: a pin lies inside a boom or an arm, an edge
/// point behind its face.
constexpr double kPinDepth_m = 0.35, kEdgeDepth_m = 0.05;

void AddPin(const std::string& name, int body, SceneModel* model) {
  model->keypoints.push_back({.name = name, .body = body, .radius_m = kPinDepth_m});
}

}  // namespace

SceneAssembly::SceneAssembly(const Scenario& scenario) : scenario_(scenario) {
  model_.instances.push_back({.name = "none"});
  model_.environment = scenario.environment;
  for (const SoilType& soil : scenario.site->soils()) {
    model_.soils.push_back({soil.albedo, soil.grain_size_m});
  }
  for (std::size_t m = 0; m < scenario.machines.size(); ++m) AddMachine(scenario, m);
  for (const ScenarioObstacle& obstacle : scenario.obstacles) AddObstacle(obstacle);
  if (scenario.site_mesh) AddSiteMesh(*scenario.site_mesh, scenario.site->surface());
  for (std::size_t m = 0; m < scenario.machines.size(); ++m) AddWhole(scenario, m);
  for (const ScenarioLamp& lamp : scenario.lamps) AddLamp(lamp);
}

void SceneAssembly::AddLamp(const ScenarioLamp& lamp) {
  Lamp added{.X_BL = lamp.X_PL, .flux_lm = lamp.flux_lm, .half_angle_rad = lamp.half_angle_rad};
  if (lamp.machine.empty()) {
    Vec3 p_W_m = lamp.X_PL.translation();
    p_W_m.z() += scenario_.site->surface().HeightAt(p_W_m.x(), p_W_m.y());
    added.X_BL.translation() = p_W_m;
  } else {
    const auto& machines = scenario_.machines;
    const auto machine = std::ranges::find_if(
        machines, [&](const ScenarioMachine& m) { return m.placement.name == lamp.machine; });
    TERA_CHECK(machine != machines.end(), lamp.machine);
    const auto m = static_cast<std::size_t>(machine - machines.begin());
    added.body = root_body_[m] + machine->placement.model.LinkIndex(lamp.link);
  }
  model_.lamps.push_back(added);
}

// AddBody is called here in the same order in which AppendMachinePoses appends poses: links,
// wheels, shoes, linkages, cylinders, soil in shovels.
void SceneAssembly::AddMachine(const Scenario& scenario, std::size_t m) {
  const MachinePlacement& placement = scenario.machines[m].placement;
  const MachineModel& machine = placement.model;
  const Wear& wear = scenario.machines[m].wear;
  const Vec3 soil = SoilAlbedoAt(*scenario.site, placement.X_WB.translation().head<2>());
  const std::vector<NodeWear> link_wear = WearOfLinks(machine, wear, soil);
  root_body_.push_back(model_.body_count);
  std::vector<int> link_body;
  std::vector<std::uint16_t> link_instance(machine.links.size(), 0);
  for (std::size_t i = 0; i < machine.links.size(); ++i) {
    const Link& link = machine.links[i];
    link_body.push_back(AddBody());
    if (link.visuals.empty()) continue;
    link_instance[i] = AddInstance(placement.name + "/" + link.name, link.label, link_body[i]);
    for (const Visual& v : link.visuals) {
      AddNode(v, link_body[i], link.label, link_instance[i], link_wear[i]);
    }
  }
  AddRunningGear(placement, m, link_body, WearInSoil(wear, soil));
  const auto add_part = [&](const std::optional<Visual>& visual, int link, const NodeWear& worn) {
    const int body = AddBody();
    if (visual) AddNode(*visual, body, machine.links[link].label, link_instance[link], worn);
  };
  const NodeWear linkage_wear = WearOfLinkage(wear, soil),
                 cylinder_wear = WearOfCylinder(wear, soil);
  for (const FourBar& linkage : machine.linkages) {
    const Joint& joint = machine.joints[linkage.joint];
    add_part(linkage.rocker, joint.parent, linkage_wear);
    add_part(linkage.coupler, joint.child, linkage_wear);
  }
  for (const Cylinder& cylinder : machine.cylinders) {
    for (int k = 0; k < cylinder.count; ++k) {
      const std::string& joint = machine.joints[cylinder.joint].name;
      const std::string number = cylinder.count > 1 ? "_" + std::to_string(k + 1) : "";
      AddPin(joint + "_barrel_pin" + number, model_.body_count, &model_);
      add_part(cylinder.barrel, cylinder.barrel_link, cylinder_wear);
      AddPin(joint + "_rod_pin" + number, model_.body_count, &model_);
      add_part(cylinder.rod, cylinder.rod_link, cylinder_wear);
    }
  }
  AddMachineKeypoints(machine, link_body);
  AddLoads(placement, m, scenario.site->soils());
  end_body_.push_back(model_.body_count);
}

void SceneAssembly::AddMachineKeypoints(const MachineModel& machine,
                                        const std::vector<int>& link_body) {
  for (const Joint& joint : machine.joints) {
    AddPin(joint.name + "_pin", link_body[joint.child], &model_);
  }
  for (const Shovel& shovel : machine.ground_tools.shovels) {
    const Vec2& edge_m = shovel.profile_B_m.front();
    const double half_m = 0.5 * shovel.width_m;
    for (const int side : {1, -1}) {
      model_.keypoints.push_back({.name = shovel.name + (side > 0 ? "_edge_left" : "_edge_right"),
                                  .body = link_body[shovel.link],
                                  .p_B_m = Vec3(edge_m.x(), side * half_m, edge_m.y()),
                                  .radius_m = kEdgeDepth_m});
    }
  }
}

/// Adds the machine as a whole after all other instances, so that it does not change their numbers.
void SceneAssembly::AddWhole(const Scenario& scenario, std::size_t m) {
  const MachinePlacement& placement = scenario.machines[m].placement;
  const bool drives = !placement.model.ground_tools.gears.empty();
  const auto id = static_cast<std::uint16_t>(model_.instances.size());
  for (SceneInstance& part : model_.instances) {
    const bool is_cargo = part.label == SemanticClass::kSoilInBucket;
    if (part.name.starts_with(placement.name + "/") && !is_cargo) part.parent = id;
  }
  for (SceneKeypoint& keypoint : model_.keypoints) {
    const bool is_own = keypoint.body >= root_body_[m] && keypoint.body < end_body_[m];
    if (is_own) keypoint.instance = id;
  }
  model_.instances.push_back({.name = placement.name,
                              .label = drives ? SemanticClass::kVehicle : SemanticClass::kStructure,
                              .body = root_body_[m],
                              .is_whole = true});
}

void SceneAssembly::AddRunningGear(const MachinePlacement& placement, std::size_t m,
                                   const std::vector<int>& link_body, const NodeWear& wear) {
  const MachineModel& machine = placement.model;
  for (const WheelVisual& wheel : machine.wheel_visuals) {
    const int body = AddBody();
    const std::string& name = machine.ground_tools.gears[wheel.gear].name;
    AddNode(wheel.visual, body, SemanticClass::kTrack,
            AddInstance(placement.name + "/" + name, SemanticClass::kTrack, body), wear);
  }
  for (const TrackVisual& track : machine.track_visuals) {
    const RunningGear& gear = machine.ground_tools.gears[track.gear];
    tracks_.push_back({m, &track, gear.ShoeRadius_m(), ArcLengths(track.path_B_m)});
    const std::uint16_t instance =
        AddInstance(placement.name + "/" + gear.name, SemanticClass::kTrack, link_body[gear.link]);
    SceneInstance& box = model_.instances[instance];
    for (const Vec3& p : track.path_B_m) {
      const Vec3 half(0, 0.5 * gear.patches.front().width_m, 0);
      box.box_min_B_m = box.box_min_B_m.cwiseMin(p - half);
      box.box_max_B_m = box.box_max_B_m.cwiseMax(p + half);
    }
    for (int k = 0; k < track.shoe_count; ++k) {
      AddNode(track.shoe, AddBody(), SemanticClass::kTrack, instance, wear);
    }
  }
}

void SceneAssembly::AddLoads(const MachinePlacement& placement, std::size_t m,
                             const std::vector<SoilType>& soils) {
  const std::vector<Shovel>& shovels = placement.model.ground_tools.shovels;
  for (std::size_t s = 0; s < shovels.size(); ++s) {
    const Shovel& shovel = shovels[s];
    if (shovel.capacity_m3 <= 0) continue;
    SceneNode node;
    node.mesh = -1;
    node.shape = model_.shape_count++;
    node.body = AddBody();
    node.label = SemanticClass::kSoilInBucket;
    node.instance =
        AddInstance(placement.name + "/" + shovel.name + "_soil", node.label, node.body);
    SceneInstance& instance = model_.instances[node.instance];
    instance.shape = node.shape;
    instance.capacity_m3 = shovel.capacity_m3;
    for (const Vec2& p : shovel.profile_B_m) {
      const Vec3 half_m(0, 0.5 * shovel.width_m, 0), p_B_m(p.x(), 0, p.y());
      instance.box_min_B_m = instance.box_min_B_m.cwiseMin(p_B_m - half_m);
      instance.box_max_B_m = instance.box_max_B_m.cwiseMax(p_B_m + half_m);
    }
    model_.nodes.push_back(node);
    loads_.push_back({m, static_cast<int>(s), CarriedSoil(shovel, soils)});
  }
}

void SceneAssembly::AddObstacle(const ScenarioObstacle& obstacle) {
  const int body = AddBody();
  const std::uint16_t instance = AddInstance(obstacle.name, obstacle.label, body);
  const Wear wear = IsWorn(obstacle.label) ? obstacle.wear : Wear{};
  const Vec3 soil = SoilAlbedoAt(*scenario_.site, obstacle.xy_W_m);
  AddNode(obstacle.visual, body, obstacle.label, instance, WearOnGround(wear, soil));
  for (const auto* visual : {&obstacle.tipping.visual, &obstacle.tipping.gate}) {
    if (!*visual) continue;
    AddNode(**visual, AddBody(), obstacle.label, instance, WearOnGround(wear, soil));
  }
  for (const ObstacleWheel& wheel : obstacle.wheels) {
    AddNode(wheel.visual, AddBody(), obstacle.label, instance, WearInSoil(wear, soil));
  }
  const int first_limb = model_.body_count;
  for (std::size_t k = 0; k < obstacle.gait.limbs.size(); ++k) {
    AddNode(obstacle.gait.limbs[k].visual, AddBody(), obstacle.label, instance,
            WearOnGround(wear, soil));
    GrowBoxByLimb(obstacle, k, model_.meshes[model_.nodes.back().mesh],
                  &model_.instances[instance]);
  }
  for (const ObstacleKeypoint& point : obstacle.keypoints) {
    model_.keypoints.push_back(
        {point.name, instance, point.limb < 0 ? body : first_limb + point.limb,
         obstacle.visual.scale * point.p_B_m, obstacle.visual.scale * point.radius_m});
  }
}

void SceneAssembly::AddSiteMesh(const SiteMesh& site, const TerrainSurface& ground) {
  model_.textures.insert(site.textures.begin(), site.textures.end());
  const int body = AddBody();
  for (const SiteMeshPart& part : site.parts) {
    SceneNode node;
    node.mesh = static_cast<int>(model_.meshes.size());
    node.body = body;
    node.label = part.label;
    node.instance = AddInstance(part.name, part.label, body);
    model_.meshes.push_back(part.mesh);
    model_.meshes.back().name = "environment.mesh#" + part.name;
    model_.nodes.push_back(node);
    GrowBox(node);
  }
  if (!site.paint) return;
  GroundPaint paint = *site.paint;
  for (int j = 0; j < paint.ny; ++j) {
    for (int i = 0; i < paint.nx; ++i) {
      const Vec2 p_m = paint.low_W_m + paint.cell_m * Vec2(i, j);
      paint.start_m[static_cast<std::size_t>(j) * paint.nx + i] =
          static_cast<float>(ground.HeightAt(p_m.x(), p_m.y()));
    }
  }
  model_.ground_paint = std::make_shared<const GroundPaint>(std::move(paint));
}

std::uint16_t SceneAssembly::AddInstance(const std::string& name, SemanticClass label, int body) {
  SceneInstance instance;
  instance.name = name;
  instance.label = label;
  instance.body = body;
  instance.box_min_B_m = Vec3::Constant(std::numeric_limits<double>::infinity());
  instance.box_max_B_m = -instance.box_min_B_m;
  model_.instances.push_back(instance);
  return static_cast<std::uint16_t>(model_.instances.size() - 1);
}

void SceneAssembly::AddNode(const Visual& visual, int body, SemanticClass label,
                            std::uint16_t instance, const NodeWear& wear) {
  SceneNode node;
  try {
    node.mesh = AddLooksOf(visual, &model_);
  } catch (const InputError& e) {
    throw InputError(visual.place, e.faults().front());
  }
  node.body = body;
  node.X_BG = visual.X_BG;
  node.scale = visual.scale;
  node.label = visual.label.value_or(label);
  node.instance = instance;
  if (wear.wear.any()) node.wear = std::make_shared<const NodeWear>(wear);
  model_.nodes.push_back(node);
  GrowBox(node);
}

void SceneAssembly::GrowBox(const SceneNode& node) {
  SceneInstance& box = model_.instances[node.instance];
  if (box.body != node.body) return;  // a part of a cylinder moves relative to its link
  for (const MeshPart& part : model_.meshes[node.mesh].parts) {
    for (const Eigen::Vector3f& p : part.positions_m) {
      const Vec3 p_B = node.X_BG * (node.scale * p.cast<double>());
      box.box_min_B_m = box.box_min_B_m.cwiseMin(p_B);
      box.box_max_B_m = box.box_max_B_m.cwiseMax(p_B);
    }
  }
}

std::vector<Pose> SceneAssembly::BodyPoses(const Instant& state) const {
  std::vector<Pose> poses;
  poses.reserve(model_.body_count);
  for (std::size_t m = 0; m < state.machines.size(); ++m) AppendMachinePoses(state, m, &poses);
  for (std::size_t o = 0; o < state.obstacles.size(); ++o) {
    AppendObstaclePoses(scenario_.obstacles[o], state.obstacles[o].X_WB, state.t_ns, &poses);
  }
  if (scenario_.site_mesh) poses.push_back(Pose::Identity());
  TERA_CHECK(static_cast<int>(poses.size()) == model_.body_count, poses.size(), model_.body_count);
  return poses;
}

void SceneAssembly::AppendMachinePoses(const Instant& state, std::size_t m,
                                       std::vector<Pose>* poses) const {
  const MachineModel& machine = scenario_.machines[m].placement.model;
  const MachineState& now = state.machines[m];
  for (const BodyState& link : now.links) poses->push_back(link.X_WB);
  for (const WheelVisual& wheel : machine.wheel_visuals) {
    const RunningGear& gear = machine.ground_tools.gears[wheel.gear];
    poses->push_back(now.links[gear.link].X_WB * MakePose(wheel.axle_B_m) *
                     Eigen::AngleAxisd(now.gear_angle_rad[wheel.gear], Vec3::UnitY()));
  }
  for (const TrackPath& path : tracks_) {
    if (path.machine != m) continue;
    const TrackVisual& track = *path.track;
    const Pose& X_WB = now.links[machine.ground_tools.gears[track.gear].link].X_WB;
    const double travel_m = path.radius_m * now.gear_angle_rad[track.gear];
    for (int k = 0; k < track.shoe_count; ++k) {
      const double s_m = travel_m + path.arc_m.back() * k / track.shoe_count;
      poses->push_back(X_WB * OnPath(track.path_B_m, path.arc_m, s_m));
    }
  }
  AppendLinkagePoses(machine, now, poses);
  AppendCylinderPoses(machine, now, poses);
  for (const ShovelLoad& load : loads_) {
    if (load.machine != m) continue;
    poses->push_back(now.links[machine.ground_tools.shovels[load.shovel].link].X_WB);
  }
}

Shapes SceneAssembly::ShapesOf(const Instant& state) const {
  Shapes shapes;
  for (const ShovelLoad& load : loads_) {
    const MachineState& machine = state.machines[load.machine];
    const Shovel& shovel =
        scenario_.machines[load.machine].placement.model.ground_tools.shovels[load.shovel];
    shapes.push_back(
        machine.shovel_load.empty()
            ? nullptr
            : load.look.Shape(machine.shovel_load[load.shovel], machine.links[shovel.link].X_WB));
  }
  return shapes;
}

}  // namespace tera
