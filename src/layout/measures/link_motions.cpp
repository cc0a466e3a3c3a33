#include "layout/measures/link_motions.h"

#include "core/check.h"

namespace tera {
namespace {

/// Adds a joint's motion. `child` contains the motion of the joint's frame J on entry.
void MoveByJoint(const Joint& joint, double q, double qd, double qdd, BodyState* child) {
  const Vec3 axis_W = child->X_WB.linear() * joint.axis_J;
  const Vec3 w_J_radps = child->w_WB_radps;
  if (joint.type == JointType::kPrismatic) {
    const Vec3 r_m = q * axis_W;
    child->v_WB_mps += w_J_radps.cross(r_m) + qd * axis_W;
    child->a_WB_mps2 += child->alpha_WB_radps2.cross(r_m) + w_J_radps.cross(w_J_radps.cross(r_m)) +
                        2 * qd * w_J_radps.cross(axis_W) + qdd * axis_W;
  } else if (joint.type != JointType::kFixed) {
    child->w_WB_radps += qd * axis_W;
    child->alpha_WB_radps2 += qdd * axis_W + qd * w_J_radps.cross(axis_W);
  }
  child->X_WB = child->X_WB * JointMotion(joint, q);
}

}  // namespace

std::vector<BodyState> MotionOfLinks(const MachineModel& model, const BodyState& root,
                                     const JointMotions& joints) {
  TERA_CHECK(joints.q.size() == model.joints.size(), joints.q.size(), model.joints.size());
  std::vector<BodyState> links(model.links.size(), root);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const Joint& joint = model.joints[j];
    BodyState& child = links[joint.child];
    child = MotionOfFixedFrame(links[joint.parent], joint.X_PJ);
    MoveByJoint(joint, joints.q[j], joints.qd[j], joints.qdd[j], &child);
  }
  return links;
}

}  // namespace tera
