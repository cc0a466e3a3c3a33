#include "physics/dynamics/inertial_effort.h"

namespace tera {
namespace {

/// Adds the wrench that accelerates a mass at `p_B_m` of `body`.
void AddMass(const BodyState& body, double mass_kg, const Vec3& p_B_m, const Vec3& about_W_m,
             Wrench* inertial) {
  const Vec3 r_W = body.X_WB.linear() * p_B_m;
  const Vec3& w = body.w_WB_radps;
  const Vec3 a_mps2 = body.a_WB_mps2 + body.alpha_WB_radps2.cross(r_W) + w.cross(w.cross(r_W));
  inertial->AddForceAt(mass_kg * a_mps2, body.X_WB.translation() + r_W, about_W_m);
}

Wrench OfLink(const Link& link, const BodyState& body, const Vec3& about_W_m) {
  Wrench inertial;
  AddMass(body, link.mass_kg, link.com_B_m, about_W_m, &inertial);
  const Mat3& R_WB = body.X_WB.linear();
  const Mat3 inertia_W_kgm2 = R_WB * link.inertia_B_kgm2 * R_WB.transpose();
  const Vec3& w = body.w_WB_radps;
  inertial.torque_W_nm += inertia_W_kgm2 * body.alpha_WB_radps2 + w.cross(inertia_W_kgm2 * w);
  return inertial;
}

}  // namespace

InertialEfforts::InertialEfforts(const MachineModel& model)
    : model_(model), beyond_(model.links.size()), joints_nm_(model.joints.size(), 0.0) {}

void InertialEfforts::Update(const MachineState& state) {
  const Vec3 about_W_m = state.links[0].X_WB.translation();
  for (std::size_t i = 0; i < beyond_.size(); ++i) {
    beyond_[i] = OfLink(model_.links[i], state.links[i], about_W_m);
  }
  for (std::size_t s = 0; s < state.shovel_load.size(); ++s) {
    const int link = model_.ground_tools.shovels[s].link;
    const SoilReaction::Load& load = state.shovel_load[s];
    AddMass(state.links[link], load.mass_kg, load.com_B_m, about_W_m, &beyond_[link]);
  }
  // Children come after their parents in the list.
  for (std::size_t k = joints_nm_.size(); k-- > 0;) {
    const Joint& joint = model_.joints[k];
    const Wrench& child = beyond_[joint.child];
    const Pose& X_WB = state.links[joint.child].X_WB;
    const Vec3 axis_W = X_WB.linear() * joint.axis_J;
    if (joint.type == JointType::kPrismatic) {
      joints_nm_[k] = axis_W.dot(child.force_W_n);
    } else if (joint.type != JointType::kFixed) {
      const Vec3 to_axis_m = X_WB.translation() - about_W_m;
      joints_nm_[k] = axis_W.dot(child.torque_W_nm - to_axis_m.cross(child.force_W_n));
    }
    beyond_[joint.parent].force_W_n += child.force_W_n;
    beyond_[joint.parent].torque_W_nm += child.torque_W_nm;
  }
}

}  // namespace tera
