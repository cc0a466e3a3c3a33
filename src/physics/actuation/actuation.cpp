#include "physics/actuation/actuation.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "physics/actuation/hydraulics.h"
#include "physics/actuation/linkage.h"

namespace tera {
namespace {

AxisParameters AxisOf(const Effects& effects, const ActuatorEffort& effort) {
  AxisParameters axis;
  axis.timing = CommandTimingOf(effects);
  axis.map = LeverMapOf(effects);
  axis.actuator = ActuatorOf(effects);
  axis.gain = KinematicGainOf(effects);
  axis.load = LoadFrictionOf(effects, effort);
  return axis;
}

/// Number of tabulated positions over the travel of a joint. Linear interpolation between them has
/// a relative error of at most 1e-4 in lever arms and displacements.
constexpr int kArms = 129;

template <typename ValueAt>
OverTravel Tabulate(const Joint& joint, const ValueAt& value_at) {
  OverTravel table{.first_rad = joint.lower_rad, .last_rad = joint.upper_rad};
  const int count = joint.lower_rad < joint.upper_rad ? kArms : 1;
  for (int i = 0; i < count; ++i) {
    const double q = std::lerp(table.first_rad, table.last_rad, i / (kArms - 1.0));
    table.values.push_back(value_at(q));
  }
  return table;
}

/// Tabulates the lever arm of the joint's first cylinder over its travel.
void AddOwnCylinder(const MachineModel& model, std::size_t joint, KinematicGainParameters* gain) {
  for (const Cylinder& cylinder : model.cylinders) {
    if (cylinder.joint != static_cast<int>(joint)) continue;
    gain->arms_m = Tabulate(model.joints[joint],
                            [&](double q) { return std::abs(ReachOf(model, cylinder, q).arm_m); });
    return;
  }
}

/// True if a cylinder with a bore drives the joint.
bool HasDrivingCylinder(const MachineModel& model, std::size_t joint) {
  return std::any_of(model.cylinders.begin(), model.cylinders.end(), [&](const Cylinder& c) {
    return c.joint == static_cast<int>(joint) && c.bore_m > 0;
  });
}

/// Sets the displacement: that of the driving cylinders, or else the joint's own constant.
void SetDisplacement(const MachineModel& model, std::size_t joint, AxisParameters* axis) {
  const Joint& j = model.joints[joint];
  if (!HasDrivingCylinder(model, joint)) {
    axis->displacement_positive_m3prad.values = {j.displacement_m3prad};
    axis->displacement_negative_m3prad.values = {j.displacement_m3prad};
    return;
  }
  const auto toward = [&](int sign) {
    return Tabulate(j, [&](double q) {
      return CylinderDisplacement_m3prad(model, static_cast<int>(joint), q, sign);
    });
  };
  axis->displacement_positive_m3prad = toward(+1);
  axis->displacement_negative_m3prad = toward(-1);
}

AxisParameters AxisOf(const Joint& joint, const Effects& effects, const ActuatorEffort& effort) {
  AxisParameters axis = AxisOf(effects, effort);
  axis.max_rate_positive_radps = joint.max_rate_positive_radps;
  axis.max_rate_negative_radps = joint.max_rate_negative_radps;
  axis.actuator.lower_rad = joint.lower_rad;
  axis.actuator.upper_rad = joint.upper_rad;
  if (joint.type == JointType::kContinuous) axis.actuator.cushion_rad = 0;
  axis.actuator.max_rate_positive_radps = joint.max_rate_positive_radps;
  axis.actuator.max_rate_negative_radps = joint.max_rate_negative_radps;
  return axis;
}

AxisParameters AxisOf(const GearDrive& drive, const Effects& effects) {
  AxisParameters axis = AxisOf(effects, ActuatorEffort::Constant(drive.max_torque_nm));
  axis.max_rate_positive_radps = axis.max_rate_negative_radps = drive.max_rate_radps;
  axis.displacement_positive_m3prad.values = {drive.displacement_m3prad};
  axis.displacement_negative_m3prad.values = {drive.displacement_m3prad};
  return axis;
}

}  // namespace

const Effects& EffectsAt(const std::vector<Effects>& effects, std::size_t k) {
  static const Effects kIdeal;
  return k < effects.size() ? effects[k] : kIdeal;
}

KinematicGainParameters GainOf(const MachineModel& model, std::size_t joint) {
  const Effects& effects = EffectsAt(model.effects.joints, joint);
  KinematicGainParameters gain = KinematicGainOf(effects);
  if (FindEffect(effects, "cylinder_lever") && gain.rod_m == 0) {
    AddOwnCylinder(model, joint, &gain);
  }
  return gain;
}

ActuatorEffort EffortOf(const MachineModel& model, std::size_t axis) {
  if (axis >= model.joints.size()) {
    return ActuatorEffort::Constant(model.gear_drives[axis - model.joints.size()].max_torque_nm);
  }
  const Joint& joint = model.joints[axis];
  if (!HasDrivingCylinder(model, axis)) return ActuatorEffort::Constant(joint.max_effort_nm);
  const auto relief = [&](double q_rad) {
    return ReliefEffort(model, static_cast<int>(axis), q_rad);
  };
  return {Tabulate(joint, [&](double q_rad) { return relief(q_rad).positive_nm; }),
          Tabulate(joint, [&](double q_rad) { return relief(q_rad).negative_nm; }),
          joint.max_effort_nm};
}

AxisActuation::AxisActuation(const AxisParameters& parameters, const Stream& drops,
                             std::int64_t first_step)
    : parameters_(parameters),
      timing_(parameters.timing, drops, first_step),
      actuator_(parameters.actuator),
      gain_(parameters.gain),
      load_(parameters.load) {}

double AxisActuation::Demand(double lever, double dt_s) {
  const double y = MapLever(parameters_.map, timing_.Step(lever, dt_s));
  return y * (y > 0 ? parameters_.max_rate_positive_radps : parameters_.max_rate_negative_radps);
}

double AxisActuation::Flow_m3ps(double rate_radps, double position_rad) const {
  const OverTravel& displacement = rate_radps > 0 ? parameters_.displacement_positive_m3prad
                                                  : parameters_.displacement_negative_m3prad;
  const double at_rad = gain_.HasLever() ? parameters_.gain.reference_rad : position_rad;
  return displacement.At(at_rad) * std::abs(rate_radps);
}

double AxisActuation::Power_w(double rate_radps, const AxisMotion& motion) const {
  return std::max(0.0, motion.load_nm * rate_radps * gain_.Gain(motion.position_rad));
}

double AxisActuation::DeliveredRate(double rate_radps, const AxisMotion& motion, double dt_s) {
  const double actuator_radps = actuator_.Step(rate_radps, motion.position_rad, dt_s);
  const double joint_radps = gain_.Step(actuator_radps, motion.position_rad, dt_s);
  return load_.Step(joint_radps, motion.load_nm, motion.position_rad, dt_s);
}

AxisDrive AxisActuation::Deliver(double rate_radps, const AxisMotion& motion, double dt_s) {
  return {DeliveredRate(rate_radps, motion, dt_s), load_.Friction(motion.rate_radps),
          load_.Offset_nm()};
}

AxisActuation AxisActuationOf(const MachineModel& model, std::size_t axis,
                              const ActuationStart& start) {
  const auto of = [&](const std::string& name, const AxisParameters& parameters) {
    const Stream drops(start.seed, start.machine + "/" + name + "/command_drops");
    return AxisActuation(parameters, drops, start.step);
  };
  if (axis >= model.joints.size()) {
    const std::size_t gear = axis - model.joints.size();
    return of(model.ground_tools.gears[gear].name,
              AxisOf(model.gear_drives[gear], EffectsAt(model.effects.gears, gear)));
  }
  const Effects& effects = EffectsAt(model.effects.joints, axis);
  const bool meets_load = FindEffect(effects, "pressure_droop") || FindEffect(effects, "sag");
  AxisParameters parameters =
      AxisOf(model.joints[axis], effects, meets_load ? EffortOf(model, axis) : ActuatorEffort());
  SetDisplacement(model, axis, &parameters);
  parameters.gain = GainOf(model, axis);
  return of(model.joints[axis].name, parameters);
}

Actuation::Actuation(const MachineModel& model, const ActuationStart& start) : step_(start.step) {
  for (std::size_t axis = 0; axis < model.joints.size() + model.gear_drives.size(); ++axis) {
    axes_.push_back(AxisActuationOf(model, axis, start));
    const LearnedEffect* learned = LearnedAt(model.effects, axis);
    learned_.push_back(learned != nullptr ? std::optional(LearnedRate(*learned)) : std::nullopt);
    reads_loads_ = reads_loads_ || (learned_.back() && learned_.back()->ReadsLoad());
  }
  demand_radps_.assign(axes_.size(), 0.0);
  drives_.resize(axes_.size());
  AddPumps(model);
  for (const AxisActuation& axis : axes_) reads_loads_ = reads_loads_ || axis.ReadsLoad();
  for (const PumpState& pump : pumps_) reads_loads_ = reads_loads_ || pump.flow.ReadsPower();
}

void Actuation::AddPumps(const MachineModel& model) {
  pump_count_.assign(axes_.size(), 0);
  for (std::size_t p = 0; p < model.pumps.size(); ++p) {
    const Pump& pump = model.pumps[p];
    const Effects& effects = EffectsAt(model.effects.pumps, p);
    PumpState state{PumpFlow(PumpFlowOf(effects, pump.max_flow_m3ps)), {}};
    for (const int joint : pump.joints) state.axes.push_back(static_cast<std::size_t>(joint));
    for (const int gear : pump.gears) state.axes.push_back(model.joints.size() + gear);
    for (const std::size_t axis : state.axes) ++pump_count_[axis];
    pumps_.push_back(std::move(state));
  }
}

void Actuation::ShareFlow(std::span<const AxisMotion> motions, double dt_s) {
  for (PumpState& pump : pumps_) {
    double flow_m3ps = 0, power_w = 0;
    for (const std::size_t k : pump.axes) {
      const double part = demand_radps_[k] / pump_count_[k];
      flow_m3ps += axes_[k].Flow_m3ps(part, motions[k].position_rad);
      power_w += axes_[k].Power_w(part, motions[k]);
    }
    pump.share = pump.flow.Step(flow_m3ps, power_w, dt_s);
  }
}

void Actuation::Step(std::span<const double> levers, std::span<const AxisMotion> motions,
                     double dt_s) {
  TERA_CHECK(levers.size() == axes_.size() && motions.size() == axes_.size(), levers.size(),
             motions.size(), axes_.size());
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    demand_radps_[k] = axes_[k].Demand(levers[k], dt_s);
  }
  ShareFlow(motions, dt_s);
  for (std::size_t k = 0; k < axes_.size(); ++k) drives_[k].rate_radps = demand_radps_[k];
  for (const PumpState& pump : pumps_) {
    if (pump.share >= 1) continue;
    for (const std::size_t k : pump.axes) {
      drives_[k].rate_radps -= (1 - pump.share) * demand_radps_[k] / pump_count_[k];
    }
  }
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    drives_[k] = axes_[k].Deliver(drives_[k].rate_radps, motions[k], dt_s);
  }
  ApplyLearned(levers, motions, dt_s);
}

void Actuation::ApplyLearned(std::span<const double> levers, std::span<const AxisMotion> motions,
                             double dt_s) {
  const double time_s = static_cast<double>(step_++) * dt_s;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    if (!learned_[k]) continue;
    const AxisMotion& motion = motions[k];
    drives_[k].rate_radps = learned_[k]->Step(
        drives_[k].rate_radps,
        {levers[learned_[k]->lever_axis()], motion.position_rad, motion.load_nm, time_s});
  }
}

}  // namespace tera
