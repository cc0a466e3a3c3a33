#include "physics/actuation/hydraulics.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// Magnitude of the greatest force with which one cylinder pushes (`sign` +1) or pulls (-1).
double ReliefForce_n(const Cylinder& cylinder, double sign) {
  const double head_m2 = HeadArea_m2(cylinder), rod_m2 = RodArea_m2(cylinder);
  const double pressed_m2 = sign > 0 ? head_m2 : rod_m2, other_m2 = sign > 0 ? rod_m2 : head_m2;
  return std::max(0.0, cylinder.relief_pa * pressed_m2 - cylinder.return_pressure_pa * other_m2);
}

/// Adds the relief effort of the cylinders of one entry at lever arm `arm_m`.
void AddReliefEffort(const Cylinder& cylinder, double arm_m, EffortLimits* limits) {
  const double arms_m = cylinder.count * std::abs(arm_m);
  limits->positive_nm += arms_m * ReliefForce_n(cylinder, arm_m);
  limits->negative_nm += arms_m * ReliefForce_n(cylinder, -arm_m);
}

/// Sets the chamber pressures that balance `force_n` on the piston.
void SetPressures(const Cylinder& cylinder, double force_n, CylinderState* state) {
  const double head_m2 = HeadArea_m2(cylinder), rod_m2 = RodArea_m2(cylinder);
  const double low_pa = cylinder.return_pressure_pa, high_pa = cylinder.relief_pa;
  // Force with both chambers at return pressure. Above it, the head side carries the load.
  const double balance_n = low_pa * (head_m2 - rod_m2);
  state->head_pressure_pa = state->rod_pressure_pa = low_pa;
  if (force_n > balance_n) {
    state->head_pressure_pa = std::min(high_pa, (force_n + low_pa * rod_m2) / head_m2);
  } else {
    state->rod_pressure_pa = std::min(high_pa, (low_pa * head_m2 - force_n) / rod_m2);
  }
}

}  // namespace

Hydraulics::Hydraulics(const MachineModel& model, const std::vector<double>& q_rad)
    : model_(model), reach_(model.cylinders.size()) {
  for (const Joint& joint : model.joints) {
    limits_.push_back({joint.max_effort_nm, joint.max_effort_nm});
  }
  Update(q_rad);
}

void Hydraulics::Update(const std::vector<double>& q_rad) {
  for (std::size_t c = 0; c < reach_.size(); ++c) {
    const Cylinder& cylinder = model_.cylinders[c];
    reach_[c] = ReachOf(model_, cylinder, q_rad[cylinder.joint]);
    if (cylinder.bore_m > 0) limits_[cylinder.joint] = {};
  }
  for (std::size_t c = 0; c < reach_.size(); ++c) {
    const Cylinder& cylinder = model_.cylinders[c];
    if (cylinder.bore_m == 0 || model_.joints[cylinder.joint].max_effort_nm == 0) continue;
    AddReliefEffort(cylinder, reach_[c].arm_m, &limits_[cylinder.joint]);
  }
}

void Hydraulics::Measure(MachineState* state) const {
  state->cylinders.resize(reach_.size());
  for (std::size_t c = 0; c < reach_.size(); ++c) {
    const Cylinder& cylinder = model_.cylinders[c];
    const double arm_m = reach_[c].arm_m;
    CylinderState& now = state->cylinders[c];
    now = {};
    now.length_m = reach_[c].length_m;
    now.stroke_m = now.length_m - cylinder.shortest_m;
    now.rate_mps = arm_m * state->qd_radps[cylinder.joint];
    const double effort_nm = state->effort_nm[cylinder.joint];
    const EffortLimits& limits = limits_[cylinder.joint];
    const double limit_nm = effort_nm < 0 ? limits.negative_nm : limits.positive_nm;
    if (cylinder.bore_m == 0 || limit_nm == 0) continue;
    const double push = std::copysign(1.0, effort_nm) * std::copysign(1.0, arm_m);
    now.force_n = push * ReliefForce_n(cylinder, push) * std::abs(effort_nm) / limit_nm;
    SetPressures(cylinder, now.force_n, &now);
  }
}

EffortLimits ReliefEffort(const MachineModel& model, int joint, double q_rad) {
  EffortLimits limits;
  for (const Cylinder& cylinder : model.cylinders) {
    if (cylinder.joint != joint || cylinder.bore_m == 0) continue;
    AddReliefEffort(cylinder, ReachOf(model, cylinder, q_rad).arm_m, &limits);
  }
  return limits;
}

}  // namespace tera
