#include "physics/inertial_effort.h"

namespace tera {
namespace {

/// What accelerates a mass: force, and torque about the base's origin, in W.
struct Inertial {
  Vec3 force_n = Vec3::Zero(), torque_nm = Vec3::Zero();

  /// Of a mass at `p_B_m` of `body`.
  void Add(const BodyState& body, double mass_kg, const Vec3& p_B_m, const Vec3& about_W_m) {
    const BodyState point = MotionOfFixedFrame(body, MakePose(p_B_m));
    const Vec3 needed_n = mass_kg * point.a_WB_mps2;
    force_n += needed_n;
    torque_nm += (point.X_WB.translation() - about_W_m).cross(needed_n);
  }
};

Inertial OfLink(const Link& link, const BodyState& body, const Vec3& about_W_m) {
  Inertial inertial;
  inertial.Add(body, link.mass_kg, link.com_B_m, about_W_m);
  const Mat3& R_WB = body.X_WB.linear();
  const Mat3 inertia_W_kgm2 = R_WB * link.inertia_B_kgm2 * R_WB.transpose();
  const Vec3& w = body.w_WB_radps;
  inertial.torque_nm += inertia_W_kgm2 * body.alpha_WB_radps2 + w.cross(inertia_W_kgm2 * w);
  return inertial;
}

}  // namespace

std::vector<double> InertialEfforts(const MachineModel& model, const MachineState& state) {
  const Vec3 about_W_m = state.links[0].X_WB.translation();
  std::vector<Inertial> beyond(model.links.size());
  for (std::size_t i = 1; i < model.links.size(); ++i) {
    beyond[i] = OfLink(model.links[i], state.links[i], about_W_m);
  }
  for (std::size_t s = 0; s < state.shovel_load.size(); ++s) {
    const int link = model.ground_tools.shovels[s].link;
    const SoilReaction::Load& load = state.shovel_load[s];
    beyond[link].Add(state.links[link], load.mass_kg, load.com_B_m, about_W_m);
  }
  std::vector<double> efforts_nm(model.joints.size(), 0.0);
  // A child stands behind its parent in the list.
  for (std::size_t k = model.joints.size(); k-- > 0;) {
    const Joint& joint = model.joints[k];
    const Inertial& child = beyond[joint.child];
    const Pose& X_WB = state.links[joint.child].X_WB;
    const Vec3 axis_W = X_WB.linear() * joint.axis_J;
    if (joint.type == JointType::kPrismatic) {
      efforts_nm[k] = axis_W.dot(child.force_n);
    } else if (joint.type != JointType::kFixed) {
      const Vec3 to_axis_m = X_WB.translation() - about_W_m;
      efforts_nm[k] = axis_W.dot(child.torque_nm - to_axis_m.cross(child.force_n));
    }
    beyond[joint.parent].force_n += child.force_n;
    beyond[joint.parent].torque_nm += child.torque_nm;
  }
  return efforts_nm;
}

}  // namespace tera
