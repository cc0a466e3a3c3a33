#include "physics/dynamics/link_motion.h"

namespace tera {
namespace {

/// Sets the velocity after a step of `dt_s`, and the accelerations from the velocity change.
void SetVelocity(const Vec3& v_WB_mps, const Vec3& w_WB_radps, double dt_s, BodyState* link) {
  if (dt_s > 0) {
    link->a_WB_mps2 = (v_WB_mps - link->v_WB_mps) / dt_s;
    link->alpha_WB_radps2 = (w_WB_radps - link->w_WB_radps) / dt_s;
  }
  link->v_WB_mps = v_WB_mps;
  link->w_WB_radps = w_WB_radps;
}

/// State of the joint's child after a step, from its parent's state.
void MoveChild(const Joint& joint, double q_rad, double qd_radps, double dt_s,
               std::vector<BodyState>* links) {
  const BodyState& parent = (*links)[joint.parent];
  BodyState& child = (*links)[joint.child];
  const Pose X_WJ = parent.X_WB * joint.X_PJ;
  child.X_WB = X_WJ * JointMotion(joint, q_rad);
  const Vec3 r_W = child.X_WB.translation() - parent.X_WB.translation();
  const Vec3 motion_W = X_WJ.linear() * joint.axis_J * qd_radps;
  Vec3 v_W_mps = parent.v_WB_mps + parent.w_WB_radps.cross(r_W), w_W_radps = parent.w_WB_radps;
  (joint.type == JointType::kPrismatic ? v_W_mps : w_W_radps) += motion_W;
  SetVelocity(v_W_mps, w_W_radps, dt_s, &child);
}

}  // namespace

void MoveLinks(const MachineModel& model, const RootMotion& root, const std::vector<double>& q_rad,
               const std::vector<double>& qd_radps, double dt_s, std::vector<BodyState>* links) {
  BodyState& base = links->front();
  base.X_WB = root.X_WB;
  SetVelocity(root.v_WB_mps, root.w_WB_radps, dt_s, &base);
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    MoveChild(model.joints[k], q_rad[k], qd_radps[k], dt_s, links);
  }
}

}  // namespace tera
