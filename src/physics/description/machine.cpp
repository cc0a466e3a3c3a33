#include "physics/description/machine.h"

#include "core/check.h"

namespace tera {
namespace {

template <typename Named>
int IndexOf(const std::vector<Named>& items, std::string_view name) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

int MachineModel::LinkIndex(std::string_view name) const { return IndexOf(links, name); }
int MachineModel::JointIndex(std::string_view name) const { return IndexOf(joints, name); }
int MachineModel::LeverIndex(std::string_view name) const { return IndexOf(levers, name); }

double MachineModel::TotalMass_kg() const {
  double mass_kg = 0;
  for (const Link& link : links) mass_kg += link.mass_kg;
  return mass_kg;
}

Pose JointMotion(const Joint& joint, double q) {
  switch (joint.type) {
    case JointType::kFixed:
      return Pose::Identity();
    case JointType::kPrismatic:
      return MakePose(q * joint.axis_J, Mat3::Identity());
    case JointType::kRevolute:
    case JointType::kContinuous:
      break;
  }
  return MakePose(Vec3::Zero(), Eigen::AngleAxisd(q, joint.axis_J).toRotationMatrix());
}

int LeaderOf(const MachineModel& model, int joint) {
  const std::optional<Following>& following = model.joints[joint].following;
  return following ? following->leader : joint;
}

void PlaceFollowers(const MachineModel& model, std::vector<double>* q_rad) {
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    if (const auto& following = model.joints[k].following) {
      (*q_rad)[k] = following->At((*q_rad)[following->leader]);
    }
  }
}

std::vector<Pose> ForwardKinematics(const MachineModel& model, const Pose& X_WB,
                                    const std::vector<double>& q_rad) {
  TERA_CHECK(q_rad.size() == model.joints.size(), q_rad.size(), model.joints.size());
  std::vector<Pose> X_WL(model.links.size(), X_WB);
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    X_WL[joint.child] = X_WL[joint.parent] * joint.X_PJ * JointMotion(joint, q_rad[k]);
  }
  return X_WL;
}

double LeftOfRoot_m(const MachineModel& model, std::size_t gear) {
  std::vector<double> q_rad;
  for (const Joint& joint : model.joints) q_rad.push_back(joint.initial_rad);
  const RunningGear& running = model.ground_tools.gears[gear];
  const Pose X_BL = ForwardKinematics(model, Pose::Identity(), q_rad)[running.link];
  double left_m = 0;
  for (const ContactPatch& patch : running.patches) {
    left_m += (X_BL * patch.p_B_m).y() / static_cast<double>(running.patches.size());
  }
  return left_m;
}

}  // namespace tera
