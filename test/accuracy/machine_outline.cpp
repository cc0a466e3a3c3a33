#include "accuracy/machine_outline.h"

namespace tera {
namespace {

void AddCorners(const CollisionBox& box, std::vector<Vec3>* points_B_m) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    points_B_m->push_back(box.X_BG * (0.5 * box.size_m.cwiseProduct(side)));
  }
}

PartOutline UndercarriageOutline(const MachineModel& model) {
  PartOutline outline{model.links[0].name, 0, {}};
  for (const RunningGear& gear : model.ground_tools.gears) {
    for (const ContactPatch& patch : gear.patches) {
      for (const double along : {-0.5, 0.5}) {
        for (const double across : {-0.5, 0.5}) {
          Vec3 p_B_m = patch.p_B_m + along * patch.length_m * patch.travel_B +
                       across * patch.width_m * Vec3::UnitY();
          outline.points_B_m.push_back(p_B_m);
          p_B_m.z() = 2 * gear.drive_radius_m - p_B_m.z();
          outline.points_B_m.push_back(p_B_m);
        }
      }
    }
  }
  for (const CollisionBox& box : model.links[0].collision) {
    if (box.X_BG.translation().y() == 0) AddCorners(box, &outline.points_B_m);
  }
  return outline;
}

PartOutline BodyOf(const Shovel& shovel) {
  PartOutline outline{shovel.name + " behind its edge", shovel.link, {}};
  for (std::size_t i = 1; i < shovel.profile_B_m.size(); ++i) {
    for (const double side : {-0.5, 0.0, 0.5}) {
      outline.points_B_m.emplace_back(shovel.profile_B_m[i].x(), side * shovel.width_m,
                                      shovel.profile_B_m[i].y());
    }
  }
  return outline;
}

}  // namespace

std::vector<PartOutline> OutlinesOf(const MachineModel& model) {
  std::vector<PartOutline> outlines = {UndercarriageOutline(model)};
  std::vector<bool> has_shovel(model.links.size(), false);
  for (const Shovel& shovel : model.ground_tools.shovels) has_shovel[shovel.link] = true;
  for (std::size_t i = 1; i < model.links.size(); ++i) {
    if (has_shovel[i] || model.links[i].collision.empty()) continue;
    outlines.push_back({model.links[i].name, static_cast<int>(i), {}});
    for (const CollisionBox& box : model.links[i].collision) {
      AddCorners(box, &outlines.back().points_B_m);
    }
  }
  for (const Shovel& shovel : model.ground_tools.shovels) {
    if (shovel.capacity_m3 > 0) outlines.push_back(BodyOf(shovel));
  }
  return outlines;
}

}  // namespace tera
