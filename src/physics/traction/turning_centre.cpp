#include "physics/traction/turning_centre.h"

#include <algorithm>

#include "core/units.h"
#include "physics/traction/track_drive.h"

namespace tera {
namespace {

constexpr double kOfCentreOfMass = 1.5;
constexpr std::size_t kMostJoints = 12;

}  // namespace

Vec2 TurningCentre_m(const MachineModel& model, const Vec3& contact_B_m,
                     const std::vector<double>& q_rad) {
  const std::vector<Pose> X_BL = ForwardKinematics(model, Pose::Identity(), q_rad);
  double mass_kg = 0;
  Vec2 moment_kgm = Vec2::Zero();
  for (std::size_t l = 0; l < model.links.size(); ++l) {
    mass_kg += model.links[l].mass_kg;
    moment_kgm += model.links[l].mass_kg * (X_BL[l] * model.links[l].com_B_m).head<2>();
  }
  return kOfCentreOfMass * (moment_kgm / mass_kg - contact_B_m.head<2>());
}

double TurningCentreReach_m(const MachineModel& model) {
  std::vector<std::size_t> moving;
  std::vector<double> q_rad(model.joints.size(), 0.0);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    q_rad[j] = model.joints[j].initial_rad;
    const bool moves = model.joints[j].type != JointType::kFixed;
    if (moves && moving.size() < kMostJoints) moving.push_back(j);
  }
  const Vec3 contact_B_m = TrackDrive(model).contact_B_m();
  double reach_m = 0;
  for (std::size_t posture = 0; posture < std::size_t{1} << moving.size(); ++posture) {
    for (std::size_t i = 0; i < moving.size(); ++i) {
      const Joint& joint = model.joints[moving[i]];
      const bool is_upper = (posture >> i & 1) != 0;
      const bool has_stops = joint.type != JointType::kContinuous;
      q_rad[moving[i]] = has_stops  ? (is_upper ? joint.upper_rad : joint.lower_rad)
                         : is_upper ? kPi
                                    : 0.0;
    }
    reach_m = std::max(reach_m, TurningCentre_m(model, contact_B_m, q_rad).norm());
  }
  return reach_m;
}

}  // namespace tera
