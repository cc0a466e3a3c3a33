#include "physics/dynamics/machine_dynamics.h"

#include <algorithm>

#include "core/check.h"
#include "physics/actuation/gear_motor.h"
#include "physics/description/payload.h"
#include "physics/dynamics/gravity_load.h"

namespace tera {
namespace {

/// Tolerance for initial joint positions outside their limits, for rounding.
constexpr double kLimitTolerance_rad = 1e-6;

/// Torque limit of a motor whose gear turns as commanded under any load.
constexpr double kUnlimited_nm = 1e9;

MachineModel WithPayloads(MachineModel model) {
  AddPayloads(&model);
  return model;
}

}  // namespace

MachineState InitialState(const MachinePlacement& placement) {
  const MachineModel& model = placement.model;
  TERA_CHECK(placement.q_rad.size() == model.joints.size(), placement.name);
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    if (joint.type != JointType::kRevolute && joint.type != JointType::kPrismatic) continue;
    TERA_CHECK(placement.q_rad[k] >= joint.lower_rad - kLimitTolerance_rad &&
                   placement.q_rad[k] <= joint.upper_rad + kLimitTolerance_rad,
               placement.name, joint.name, placement.q_rad[k]);
  }
  const std::size_t gears = model.ground_tools.gears.size();
  MachineState state;
  state.links.resize(model.links.size());
  state.q_rad = placement.q_rad;
  state.qd_radps.assign(model.joints.size(), 0.0);
  state.effort_nm.assign(model.joints.size(), 0.0);
  state.friction_nm.assign(model.joints.size(), 0.0);
  state.gear_angle_rad.assign(gears, 0.0);
  state.gear_rate_radps.assign(gears, 0.0);
  state.gear_torque_nm.assign(gears, 0.0);
  state.gear_friction_nm.assign(gears, 0.0);
  state.gear_sinkage_m.assign(gears, 0.0);
  state.gear_slip.assign(gears, 0.0);
  state.levers.assign(model.levers.size(), 0.0);
  state.shovel_load.resize(model.ground_tools.shovels.size());
  return state;
}

MachineDynamics::MachineDynamics(const MachinePlacement& placement, const WorldStart& start,
                                 bool meets_others, btMultiBodyDynamicsWorld* world)
    : model_(WithPayloads(placement.model)),
      tracks_(model_),
      body_(model_, placement.X_WB, placement.q_rad, meets_others, world),
      hydraulics_(model_, placement.q_rad),
      actuation_(model_, {placement.name, start.seed, start.step}),
      inertial_(model_),
      resting_nm_(GravityLoads_nm(model_, placement.X_WB, placement.q_rad)),
      start_rad_(placement.q_rad) {
  if (model_.ground == GroundModel::kTerramechanics) return;
  body_.AddBaseDrive(tracks_.contact_B_m());
  for (GearDrive& drive : model_.gear_drives) drive.max_torque_nm = kUnlimited_nm;
}

double MachineDynamics::GearTorque_nm(const std::vector<double>& traction_n,
                                      std::size_t gear) const {
  return gear < traction_n.size()
             ? traction_n[gear] * model_.ground_tools.gears[gear].ShoeRadius_m()
             : 0.0;
}

void MachineDynamics::Command(const std::vector<double>& levers, MachineState* state) {
  TERA_CHECK(levers.size() == model_.levers.size(), levers.size(), model_.levers.size());
  axis_lever_.assign(model_.joints.size() + model_.gear_drives.size(), 0.0);
  for (std::size_t i = 0; i < levers.size(); ++i) {
    const Lever& lever = model_.levers[i];
    const double u = std::clamp(levers[i], -1.0, 1.0);
    state->levers[i] = u;
    if (lever.joint >= 0) axis_lever_[lever.joint] = u;
    if (lever.gear >= 0) axis_lever_[model_.joints.size() + lever.gear] = u;
  }
}

void MachineDynamics::Actuate(const std::vector<double>& traction_n, double dt_s,
                              const MachineState& state) {
  const std::size_t joints = model_.joints.size();
  axis_motion_.resize(axis_lever_.size());
  for (std::size_t j = 0; j < joints; ++j) {
    axis_motion_[j] = {state.q_rad[j], state.qd_radps[j], 0};
  }
  for (std::size_t g = 0; g < model_.gear_drives.size(); ++g) {
    axis_motion_[joints + g] = {state.gear_angle_rad[g], state.gear_rate_radps[g], 0};
  }
  if (actuation_.reads_loads()) MeasureLoads(traction_n, state);
  actuation_.Step(axis_lever_, axis_motion_, dt_s);
}

void MachineDynamics::MeasureLoads(const std::vector<double>& traction_n,
                                   const MachineState& state) {
  inertial_.Update(state);
  for (std::size_t j = 0; j < model_.joints.size(); ++j) {
    axis_motion_[j].load_nm =
        resting_nm_.empty() ? state.effort_nm[j] + state.friction_nm[j] - inertial_.joints_nm()[j]
                            : resting_nm_[j];
  }
  resting_nm_.clear();
  const BaseEffort inertial = tracks_.AboutContact(inertial_.machine(), state.links[0].X_WB);
  for (std::size_t g = 0; g < model_.gear_drives.size() && g < traction_n.size(); ++g) {
    axis_motion_[model_.joints.size() + g].load_nm =
        (traction_n[g] - tracks_.Share_n(inertial, g)) *
        model_.ground_tools.gears[g].ShoeRadius_m();
  }
}

void MachineDynamics::DriveJoints(double dt_s, const MachineState& state) {
  joint_target_.resize(model_.joints.size());
  for (std::size_t j = 0; j < model_.joints.size(); ++j) {
    const Joint& joint = model_.joints[j];
    if (joint.gear >= 0) {
      const double to_rad = start_rad_[j] + joint.gear_ratio * state.gear_angle_rad[joint.gear];
      joint_target_[j] = {(to_rad - state.q_rad[j]) / dt_s, kUnlimited_nm, kUnlimited_nm};
      continue;
    }
    const EffortLimits& limits = hydraulics_.limits()[j];
    const AxisDrive& drive = actuation_.drives()[j];
    joint_target_[j] = {drive.rate_radps, limits.positive_nm, limits.negative_nm, drive.friction,
                        drive.offset_nm};
  }
  body_.DriveJoints(joint_target_);
}

void MachineDynamics::TurnGears(const SoilReaction& soil, double dt_s, MachineState* state) {
  for (std::size_t g = 0; g < model_.gear_drives.size(); ++g) {
    const GearDrive& drive = model_.gear_drives[g];
    double& rate = state->gear_rate_radps[g];
    const double load_nm = GearTorque_nm(soil.gear_traction_n, g);
    const AxisDrive& target = actuation_.drives()[model_.joints.size() + g];
    const GearTorques torques = DriveGear(drive, target, rate, load_nm, dt_s);
    rate += (torques.motor_nm - (load_nm - torques.friction_nm)) * dt_s / drive.inertia_kgm2;
    state->gear_angle_rad[g] += rate * dt_s;
    state->gear_torque_nm[g] = torques.motor_nm;
    state->gear_friction_nm[g] = torques.friction_nm;
  }
}

SoilReaction MachineDynamics::OnDrivenBase(const SoilReaction& soil, double dt_s,
                                           const MachineState& state) const {
  SoilReaction reaction = soil;
  reaction.gear_traction_n = tracks_.Traction_n(body_.BaseDriveEffort(dt_s), state);
  return reaction;
}

void MachineDynamics::Act(const MachineInput& input, double dt_s, MachineState* state) {
  Command(input.levers, state);
  if (model_.ground == GroundModel::kTerramechanics) {
    Actuate(last_traction_n_, dt_s, *state);
    TurnGears(input.soil, dt_s, state);
    last_traction_n_ = input.soil.gear_traction_n;
  } else {
    const SoilReaction soil = OnDrivenBase(input.soil, dt_s, *state);
    Actuate(soil.gear_traction_n, dt_s, *state);
    TurnGears(soil, dt_s, state);
    const TrackDrive::Target target = tracks_.Follow(*state, input.soil);
    body_.DriveBase(target.twist, target.most);
  }
  DriveJoints(dt_s, *state);
  body_.SetLoads(input.soil.shovel_load);
  body_.ApplyWrenches(input.soil.link_wrench, state->links);
  if (!input.soil.shovel_load.empty()) state->shovel_load = input.soil.shovel_load;
  if (!input.soil.gear_sinkage_m.empty()) state->gear_sinkage_m = input.soil.gear_sinkage_m;
  if (!input.soil.gear_slip.empty()) state->gear_slip = input.soil.gear_slip;
}

void MachineDynamics::Read(double dt_s, MachineState* state) {
  body_.ReadState(dt_s, state);
  hydraulics_.Update(state->q_rad);
  hydraulics_.Measure(state);
}

}  // namespace tera
