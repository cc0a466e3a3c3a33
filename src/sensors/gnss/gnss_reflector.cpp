#include "sensors/gnss/gnss_reflector.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tera {
namespace {

/// Joints from the root to a link, in this order.
std::vector<int> JointsTo(const MachineModel& model, int link) {
  std::vector<int> joints;
  for (; link > 0; link = model.joints[link - 1].parent) joints.push_back(link - 1);
  std::reverse(joints.begin(), joints.end());
  return joints;
}

bool Moves(const Joint& joint) { return joint.type != JointType::kFixed; }

/// True if a joint tilts its child while the root is upright. `X_BL` holds the poses of the links.
bool Tilts(const Joint& joint, const std::vector<Pose>& X_BL) {
  if (joint.type != JointType::kRevolute && joint.type != JointType::kContinuous) return false;
  const Vec3 axis_B = (X_BL[joint.parent] * joint.X_PJ).linear() * joint.axis_J.normalized();
  return std::abs(axis_B.z()) < std::sqrt(0.5);
}

/// The part that joint `chain[k]` moves.
std::optional<GnssReflector> PartOf(const MachineModel& model, const std::vector<int>& chain,
                                    std::size_t k) {
  const int link = model.joints[chain[k]].child;
  Vec3 tip_B_m = model.links[link].com_B_m;
  Pose X_BP = Pose::Identity();  // pose of the next joint's parent, across fixed joints
  for (std::size_t next = k + 1; next < chain.size(); ++next) {
    X_BP = X_BP * model.joints[chain[next]].X_PJ;
    if (!Moves(model.joints[chain[next]])) continue;
    if (X_BP.translation().norm() > 0) tip_B_m = X_BP.translation();
    break;
  }
  if (tip_B_m.norm() == 0) return std::nullopt;
  return GnssReflector{link, tip_B_m.normalized()};
}

}  // namespace

std::optional<GnssReflector> GnssReflectorOf(const MachineModel& model, int antenna_link) {
  std::vector<double> q_rad;
  for (const Joint& joint : model.joints) q_rad.push_back(joint.initial_rad);
  const std::vector<Pose> X_BL = ForwardKinematics(model, Pose::Identity(), q_rad);
  const std::vector<int> own = JointsTo(model, antenna_link);
  std::optional<GnssReflector> reflector;
  std::ptrdiff_t most = 0;
  for (int link = 1; link < static_cast<int>(model.links.size()); ++link) {
    const std::vector<int> chain = JointsTo(model, link);
    const auto beyond = std::mismatch(chain.begin(), chain.end(), own.begin(), own.end()).first;
    const std::ptrdiff_t moving =
        std::count_if(beyond, chain.end(), [&](int joint) { return Moves(model.joints[joint]); });
    const auto tilting = std::find_if(beyond, chain.end(),
                                      [&](int joint) { return Tilts(model.joints[joint], X_BL); });
    if (moving <= most || tilting == chain.end()) continue;
    if (const auto part = PartOf(model, chain, static_cast<std::size_t>(tilting - chain.begin()))) {
      reflector = part;
      most = moving;
    }
  }
  return reflector;
}

}  // namespace tera
