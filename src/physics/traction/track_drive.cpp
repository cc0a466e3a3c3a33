#include "physics/traction/track_drive.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace tera {
namespace {

/// A patch more than this above the lowest patch is outside the contact of a flat track.
constexpr double kLevel_m = 0.01;

/// Extent of the contact with level ground, in the root's frame.
struct Contact {
  double low_m = std::numeric_limits<double>::infinity();
  double rear_m = std::numeric_limits<double>::infinity();
  double front_m = -std::numeric_limits<double>::infinity();
};

Contact ContactOf(const MachineModel& model) {
  std::vector<double> q_rad;
  for (const Joint& joint : model.joints) q_rad.push_back(joint.initial_rad);
  const std::vector<Pose> X_BL = ForwardKinematics(model, Pose::Identity(), q_rad);
  Contact contact;
  for (const RunningGear& gear : model.ground_tools.gears) {
    for (const ContactPatch& patch : gear.patches) {
      contact.low_m = std::min(contact.low_m, (X_BL[gear.link] * patch.p_B_m).z());
    }
  }
  for (const RunningGear& gear : model.ground_tools.gears) {
    for (const ContactPatch& patch : gear.patches) {
      const Vec3 p_B = X_BL[gear.link] * patch.p_B_m;
      if (p_B.z() > contact.low_m + kLevel_m) continue;
      contact.rear_m = std::min(contact.rear_m, p_B.x() - 0.5 * patch.length_m);
      contact.front_m = std::max(contact.front_m, p_B.x() + 0.5 * patch.length_m);
    }
  }
  return contact;
}

}  // namespace

void SetShoeRatios(MachineModel* model) {
  const TrackSpeeds shoes = ShoeSpeeds({1, 1}, TrackKinematicsOf(model->effects.base));
  for (std::size_t g = 0; g < model->ground_tools.gears.size(); ++g) {
    model->ground_tools.gears[g].shoe_ratio =
        LeftOfRoot_m(*model, g) > 0 ? shoes.left_mps : shoes.right_mps;
  }
}

TrackDrive::TrackDrive(const MachineModel& model)
    : parameters_(TrackKinematicsOf(model.effects.base)) {
  const GroundTools& tools = model.ground_tools;
  double left_m = 0, right_m = 0;
  for (std::size_t g = 0; g < tools.gears.size(); ++g) {
    const double y_m = LeftOfRoot_m(model, g);
    gears_.push_back({y_m > 0, tools.gears[g].ShoeRadius_m(), model.gear_drives[g].max_torque_nm});
    (y_m > 0 ? left_count_ : right_count_) += 1;
    (y_m > 0 ? left_m : right_m) += y_m;
  }
  for (const Shovel& shovel : tools.shovels) {
    if (std::count(tool_links_.begin(), tool_links_.end(), shovel.link) == 0) {
      tool_links_.push_back(shovel.link);
    }
  }
  const Contact contact = ContactOf(model);
  geometry_ = {.gauge_m = model.gauge_m,
               .contact_length_m = contact.front_m - contact.rear_m,
               .weight_n = model.TotalMass_kg() * kStandardGravity_mps2};
  if (left_count_ == 0 || right_count_ == 0) return;
  contact_B_m_ = Vec3(0.5 * (contact.front_m + contact.rear_m),
                      0.5 * (left_m / left_count_ + right_m / right_count_), contact.low_m);
}

bool TrackDrive::MovesOnLevelGround() const {
  return MoveOnTracks({1, 1}, {}, geometry_, parameters_).forward_mps > 0;
}

TrackCircumstances TrackDrive::CircumstancesOf(const MachineState& state,
                                               const SoilReaction& soil) const {
  TrackCircumstances c;
  const Pose& X_WB = state.links[0].X_WB;
  const Vec3 rpy = RpyFromRotation(X_WB.linear());
  c.roll_rad = rpy.x();
  c.pitch_rad = rpy.y();
  const Vec3 contact_W = X_WB * contact_B_m_;
  Wrench tools;
  for (const int link : tool_links_) {
    if (link >= static_cast<int>(soil.link_wrench.size())) continue;
    const Wrench& wrench = soil.link_wrench[link];
    tools.AddForceAt(wrench.force_W_n, state.links[link].X_WB.translation(), contact_W);
    tools.torque_W_nm += wrench.torque_W_nm;
  }
  const Mat3 R_BW = X_WB.linear().transpose();
  c.tool_force_B_n = (R_BW * tools.force_W_n).head<2>();
  c.tool_torque_B_nm = (R_BW * tools.torque_W_nm).z();
  return c;
}

double TrackDrive::Resistance_n(const MachineState& state) const {
  const double upright = std::max(0.0, state.links[0].X_WB.linear()(2, 2));
  return parameters_.resistance * geometry_.weight_n * upright;
}

TrackDrive::Target TrackDrive::Follow(const MachineState& state, const SoilReaction& soil) const {
  TrackSpeeds shoes;
  double motors_n = 0, grip_n = 0;
  for (std::size_t g = 0; g < gears_.size(); ++g) {
    const Gear& gear = gears_[g];
    const double speed_mps = gear.radius_m * state.gear_rate_radps[g];
    (gear.left ? shoes.left_mps : shoes.right_mps) +=
        speed_mps / (gear.left ? left_count_ : right_count_);
    motors_n += gear.max_torque_nm / gear.radius_m;
    if (g < soil.gear_grip_n.size()) grip_n += soil.gear_grip_n[g];
  }
  Target target;
  target.twist = MoveOnTracks(shoes, CircumstancesOf(state, soil), geometry_, parameters_);
  target.most.forward_n = std::min(grip_n, std::max(0.0, motors_n - Resistance_n(state)));
  target.most.left_n = grip_n;
  target.most.yaw_nm = 0.5 * geometry_.gauge_m * grip_n;
  return target;
}

BaseEffort TrackDrive::AboutContact(const Wrench& wrench, const Pose& X_WB) const {
  const Mat3& R_WB = X_WB.linear();
  const Vec3 force_B_n = R_WB.transpose() * wrench.force_W_n;
  const Vec3 torque_B_nm = R_WB.transpose() * wrench.torque_W_nm - contact_B_m_.cross(force_B_n);
  return {force_B_n.x(), force_B_n.y(), torque_B_nm.z()};
}

double TrackDrive::Share_n(const BaseEffort& effort, std::size_t gear) const {
  if (left_count_ == 0 || right_count_ == 0 || geometry_.gauge_m == 0) {
    return effort.forward_n / static_cast<double>(gears_.size());
  }
  const double turning_n = effort.yaw_nm / geometry_.gauge_m;
  return gears_[gear].left ? (0.5 * effort.forward_n - turning_n) / left_count_
                           : (0.5 * effort.forward_n + turning_n) / right_count_;
}

std::vector<double> TrackDrive::Traction_n(const BaseEffort& effort,
                                           const MachineState& state) const {
  const double resistance_n = Resistance_n(state) / static_cast<double>(gears_.size());
  std::vector<double> traction_n;
  for (std::size_t g = 0; g < gears_.size(); ++g) {
    const double rate = state.gear_rate_radps[g];
    const double direction = rate > 0 ? 1 : rate < 0 ? -1 : 0;
    traction_n.push_back(Share_n(effort, g) + direction * resistance_n);
  }
  return traction_n;
}

}  // namespace tera
