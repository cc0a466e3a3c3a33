#include "physics/description/fixed_links.h"

namespace tera {
namespace {

/// Adds `mass_kg` to `link`. Its centre is `com_m` and its inertia is about that centre, both in
/// the link's frame.
void AddMass(double mass_kg, const Vec3& com_m, const Mat3& inertia_kgm2, Link* link) {
  const double total_kg = link->mass_kg + mass_kg;
  const Vec3 apart_m = com_m - link->com_B_m;
  const double reduced_kg = link->mass_kg * mass_kg / total_kg;
  link->inertia_B_kgm2 += inertia_kgm2 + reduced_kg * (apart_m.squaredNorm() * Mat3::Identity() -
                                                       apart_m * apart_m.transpose());
  link->com_B_m += mass_kg / total_kg * apart_m;
  link->mass_kg = total_kg;
}

void TakeMass(Link* link) {
  link->mass_kg = 0;
  link->com_B_m = Vec3::Zero();
  link->inertia_B_kgm2 = Mat3::Zero();
}

}  // namespace

void GatherFixedMasses(MachineModel* model) {
  const std::size_t count = model->links.size();
  // for each link, the moving link that it is rigidly attached to
  std::vector<int> carrier(count, 0);
  std::vector<Pose> X_CB(count, Pose::Identity());
  std::vector<bool> without(count, false);
  without[0] = model->links[0].mass_kg == 0 && !model->fixed_base;
  if (without[0]) TakeMass(&model->links[0]);
  for (const Joint& joint : model->joints) {
    Link& link = model->links[joint.child];
    if (joint.type != JointType::kFixed) {
      carrier[joint.child] = joint.child;
      without[joint.child] = link.mass_kg == 0;
      if (link.mass_kg == 0) TakeMass(&link);
      continue;
    }
    const int c = carrier[joint.child] = carrier[joint.parent];
    X_CB[joint.child] = X_CB[joint.parent] * joint.X_PJ;
    if (!without[c] || link.mass_kg == 0) continue;
    const Pose& X = X_CB[joint.child];
    AddMass(link.mass_kg, X * link.com_B_m,
            X.linear() * link.inertia_B_kgm2 * X.linear().transpose(), &model->links[c]);
    TakeMass(&link);
  }
}

}  // namespace tera
