#include "sim/machine_wear.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// Poses of all links in the root's frame with all joints at zero.
std::vector<Pose> PosesAtZero(const MachineModel& machine) {
  std::vector<Pose> X_RB(machine.links.size(), Pose::Identity());
  for (const Joint& joint : machine.joints) X_RB[joint.child] = X_RB[joint.parent] * joint.X_PJ;
  return X_RB;
}

/// Height of the ground in the root's frame: that of the lowest point of its running gear.
double GroundHeight_m(const MachineModel& machine, const std::vector<Pose>& X_RB) {
  double lowest_m = 0;
  bool found = false;
  for (const RunningGear& gear : machine.ground_tools.gears) {
    for (const ContactPatch& patch : gear.patches) {
      const double z_m = (X_RB[gear.link] * patch.p_B_m).z();
      lowest_m = found ? std::min(lowest_m, z_m) : z_m;
      found = true;
    }
  }
  return lowest_m;
}

bool CarriesGear(const MachineModel& machine, int link) {
  return std::ranges::any_of(machine.ground_tools.gears,
                             [&](const RunningGear& gear) { return gear.link == link; });
}

constexpr double kLinkageFromSoil_m = 0.25, kCylinderFromSoil_m = 0.9;

NodeWear WearAway(const Wear& wear, const Vec3& soil_albedo, double from_soil_m) {
  return {.wear = wear, .soil_albedo = soil_albedo, .from_soil_offset_m = from_soil_m};
}

}  // namespace

NodeWear WearInSoil(const Wear& wear, const Vec3& soil_albedo) {
  return {.wear = wear, .soil_albedo = soil_albedo};
}

NodeWear WearOnGround(const Wear& wear, const Vec3& soil_albedo) {
  return {.wear = wear, .soil_albedo = soil_albedo, .from_soil_normal_B = Vec3::UnitZ()};
}

NodeWear WearOfLinkage(const Wear& wear, const Vec3& soil_albedo) {
  return WearAway(wear, soil_albedo, kLinkageFromSoil_m);
}

NodeWear WearOfCylinder(const Wear& wear, const Vec3& soil_albedo) {
  return WearAway(wear, soil_albedo, kCylinderFromSoil_m);
}

bool IsWorn(SemanticClass label) {
  return label != SemanticClass::kPerson && label != SemanticClass::kRock &&
         label != SemanticClass::kVegetation;
}

Vec3 SoilAlbedoAt(const Site& site, const Vec2& xy_W_m) {
  const TerrainSurface& ground = site.surface();
  const Vec2 at = (xy_W_m - ground.origin_W_m) / ground.cell_m;
  const int i = std::clamp(static_cast<int>(std::lround(at.x())), 0, ground.nx - 1);
  const int j = std::clamp(static_cast<int>(std::lround(at.y())), 0, ground.ny - 1);
  return site.soils()[ground.at(i, j).cover.soil].albedo;
}

std::vector<NodeWear> WearOfLinks(const MachineModel& machine, const Wear& wear,
                                  const Vec3& soil_albedo) {
  const std::vector<Pose> X_RB = PosesAtZero(machine);
  const double ground_m = GroundHeight_m(machine, X_RB);
  std::vector<NodeWear> worn;
  for (const Pose& X : X_RB) {
    NodeWear link = WearOnGround(wear, soil_albedo);
    link.from_soil_normal_B = X.linear().row(2);
    link.from_soil_offset_m = X.translation().z() - ground_m;
    worn.push_back(link);
  }
  for (const Shovel& shovel : machine.ground_tools.shovels) {
    NodeWear& tool = worn[shovel.link];
    tool = WearInSoil(wear, soil_albedo);
    if (!shovel.profile_B_m.empty()) tool.edge_B_m = shovel.profile_B_m.front();
    const auto joint = std::ranges::find(machine.joints, shovel.link, &Joint::child);
    if (joint == machine.joints.end() || CarriesGear(machine, joint->parent)) continue;
    const Vec3 to_tool_m = joint->X_PJ.translation();
    if (to_tool_m.norm() < 1e-6) continue;
    worn[joint->parent].from_soil_normal_B = -to_tool_m.normalized();
    worn[joint->parent].from_soil_offset_m = to_tool_m.norm();
  }
  return worn;
}

}  // namespace tera
