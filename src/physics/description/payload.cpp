#include "physics/description/payload.h"

namespace tera {
namespace {

/// Inertia of a point mass at `r_m` about the origin.
Mat3 PointInertia(double mass_kg, const Vec3& r_m) {
  return mass_kg * (r_m.squaredNorm() * Mat3::Identity() - r_m * r_m.transpose());
}

void AddPoint(double mass_kg, const Vec3& p_B_m, Link* link) {
  const double total_kg = link->mass_kg + mass_kg;
  const Vec3 com_B_m = (link->mass_kg * link->com_B_m + mass_kg * p_B_m) / total_kg;
  link->inertia_B_kgm2 +=
      PointInertia(link->mass_kg, link->com_B_m - com_B_m) + PointInertia(mass_kg, p_B_m - com_B_m);
  link->mass_kg = total_kg;
  link->com_B_m = com_B_m;
}

}  // namespace

void AddPayloads(MachineModel* model) {
  for (std::size_t j = 0; j < model->effects.joints.size(); ++j) {
    const Effect* payload = FindEffect(model->effects.joints[j], "payload");
    if (!payload) continue;
    const Vec3 p_B_m((*payload)["x_m"], (*payload)["y_m"], (*payload)["z_m"]);
    AddPoint((*payload)["mass_kg"], p_B_m, &model->links[model->joints[j].child]);
  }
}

}  // namespace tera
