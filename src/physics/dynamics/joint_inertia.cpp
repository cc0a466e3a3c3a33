#include "physics/dynamics/joint_inertia.h"

#include "physics/dynamics/inertial_effort.h"

namespace tera {
namespace {

/// Marks the links that a joint carries: its child and all links beyond.
std::vector<bool> LinksBeyond(const MachineModel& model, const Joint& joint) {
  std::vector<bool> beyond(model.links.size(), false);
  beyond[joint.child] = true;
  for (const Joint& other : model.joints) {
    if (beyond[other.parent]) beyond[other.child] = true;
  }
  return beyond;
}

}  // namespace

std::vector<double> JointInertias_kgm2(const MachineModel& model,
                                       const std::vector<double>& q_rad) {
  const std::vector<Pose> X_BL = ForwardKinematics(model, Pose::Identity(), q_rad);
  InertialEfforts efforts(model);
  std::vector<double> inertia_kgm2;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    // The inertia is the effort of a unit acceleration from rest.
    const Joint& joint = model.joints[j];
    const std::vector<bool> beyond = LinksBeyond(model, joint);
    const Pose& X_BC = X_BL[joint.child];
    const Vec3 axis_B = X_BC.linear() * joint.axis_J;
    MachineState state;
    for (std::size_t l = 0; l < model.links.size(); ++l) {
      BodyState& link = state.links.emplace_back();
      link.X_WB = X_BL[l];
      if (!beyond[l]) continue;
      if (joint.type == JointType::kPrismatic) {
        link.a_WB_mps2 = axis_B;
      } else if (joint.type != JointType::kFixed) {
        link.alpha_WB_radps2 = axis_B;
        link.a_WB_mps2 = axis_B.cross(X_BL[l].translation() - X_BC.translation());
      }
    }
    efforts.Update(state);
    inertia_kgm2.push_back(efforts.joints_nm()[j]);
  }
  return inertia_kgm2;
}

double YawInertia_kgm2(const MachineModel& model, const std::vector<double>& q_rad) {
  const std::vector<Pose> X_BL = ForwardKinematics(model, Pose::Identity(), q_rad);
  double mass_kg = 0, about_root_kgm2 = 0;
  Vec2 moment_kgm = Vec2::Zero();
  for (std::size_t l = 0; l < model.links.size(); ++l) {
    const Link& link = model.links[l];
    const Vec2 com_B_m = (X_BL[l] * link.com_B_m).head<2>();
    const Mat3 R_BL = X_BL[l].linear();
    mass_kg += link.mass_kg;
    moment_kgm += link.mass_kg * com_B_m;
    about_root_kgm2 += (R_BL * link.inertia_B_kgm2 * R_BL.transpose())(2, 2) +
                       link.mass_kg * com_B_m.squaredNorm();
  }
  return about_root_kgm2 - moment_kgm.squaredNorm() / mass_kg;
}

}  // namespace tera
