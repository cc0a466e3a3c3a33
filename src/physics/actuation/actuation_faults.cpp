#include "physics/actuation/actuation_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/actuation/actuation.h"

namespace tera {
namespace {

/// With a smaller lever arm a cylinder cannot move its joint.
constexpr double kLeastArm_m = 1e-3;

std::string_view EffortKey(const Joint& joint) {
  return joint.type == JointType::kPrismatic ? "max_effort_n" : "max_effort_nm";
}

/// Reason why nothing moves an axis at a commanded rate; empty if something does.
std::string WhyUndriven(bool has_lever, double max_rate_radps, double max_effort_nm,
                        std::string_view effort_key) {
  if (!has_lever) return "no lever of the machine drives it; name it under levers";
  if (max_rate_radps <= 0) return "its rate at full lever is 0; give it one";
  if (max_effort_nm <= 0) return fmt::format("its {} is 0; give it some", effort_key);
  return "";
}

std::string WhyJointUndriven(const MachineModel& model, std::size_t joint) {
  const bool has_lever =
      std::any_of(model.levers.begin(), model.levers.end(),
                  [&](const Lever& lever) { return lever.joint == static_cast<int>(joint); });
  const Joint& j = model.joints[joint];
  return WhyUndriven(has_lever, std::max(j.max_rate_positive_radps, j.max_rate_negative_radps),
                     j.max_effort_nm, EffortKey(j));
}

/// True if a mechanism acts on a commanded rate, and so has no effect on an undriven axis. It
/// includes structural_flex: its effect on an undriven joint is not modelled, although a flexible
/// link also yields to its load.
bool ShapesRate(const Mechanism& mechanism) {
  return mechanism.slot < Slot::kLoadFriction || mechanism.id == "pressure_droop" ||
         mechanism.id == "drive_friction" || mechanism.id == "structural_flex";
}

/// The properties of a joint or gear that its effects depend on.
struct Axis {
  std::string undriven;  ///< reason why nothing drives it; empty if something does
  double max_rate_positive_radps = 0, max_rate_negative_radps = 0;
  double max_effort_nm = 0;
  std::string_view effort_key;
  ActuatorEffort effort;
};

/// Message if a dead band covers the full lever range in one direction; otherwise empty.
std::string FaultOfDeadBand(const LeverMapParameters& map) {
  const double end_positive = std::min(1.0, map.limit_positive);
  const double end_negative = std::min(1.0, map.limit_negative);
  const bool positive = map.dead_positive - end_positive >= map.dead_negative - end_negative;
  const double dead = positive ? map.dead_positive : map.dead_negative;
  const double end = positive ? end_positive : end_negative;
  if (dead < end) return "";
  return fmt::format(
      "takes up {} levers as far as {:g}, but they end at {:g}{}, so that none of them acts; need "
      "less than that in width (1 + |asymmetry|)",
      positive ? "positive" : "negative", dead, end, end < 1 ? " by lever_saturation" : "");
}

/// Message if friction alone exceeds the stall effort of pressure_droop; otherwise empty.
std::string FaultOfDroop(const Effects& effects, const Axis& axis) {
  const LoadFrictionParameters load = LoadFrictionOf(effects, axis.effort);
  const LeverMapParameters map = LeverMapOf(effects);
  for (const double lever : {1.0, -1.0}) {
    const double full_radps =
        lever > 0 ? axis.max_rate_positive_radps : axis.max_rate_negative_radps;
    if (full_radps <= 0) continue;
    const double rate_radps = full_radps * std::abs(MapLever(map, lever));
    const AxisFriction friction = LoadFriction(load).Friction(std::copysign(rate_radps, lever));
    const double against_nm =
        friction.viscous_nmsprad * rate_radps +
        (lever > 0 ? friction.against_positive_nm : friction.against_negative_nm);
    const std::vector<double>& stalls =
        (lever > 0 ? load.stall_positive_nm : load.stall_negative_nm).values;
    const double stall_nm = *std::min_element(stalls.begin(), stalls.end());
    if (against_nm < stall_nm) continue;
    return fmt::format(
        "has the axis stand still at {:g}, but at full {} lever its friction alone is "
        "{:g}; need more than that, or less friction",
        stall_nm, lever > 0 ? "positive" : "negative", against_nm);
  }
  return "";
}

/// Message if dry friction holds the axis at rest at full lever in one direction; otherwise empty.
std::string FaultOfDriveFriction(const Effects& effects, const Axis& axis) {
  const LoadFrictionParameters load = LoadFrictionOf(effects, axis.effort);
  const double held_radps = load.lost_radps * load.breakaway;
  if (held_radps == 0) return "";
  const LeverMapParameters map = LeverMapOf(effects);
  for (const double lever : {1.0, -1.0}) {
    const double full_radps =
        lever > 0 ? axis.max_rate_positive_radps : axis.max_rate_negative_radps;
    const double asked_radps = full_radps * std::abs(MapLever(map, lever));
    if (asked_radps == 0 || held_radps < asked_radps) continue;
    return fmt::format(
        "holds the axis at rest until {:g} is asked of it, but a full {} lever asks for {:g}; need "
        "less in lost_radps times breakaway",
        held_radps, lever > 0 ? "positive" : "negative", asked_radps);
  }
  return "";
}

/// Faults of a joint or gear: effects on an undriven axis, a leak without effort to drive it, and
/// numbers with which a full lever causes no motion.
std::vector<EffectFault> FaultsOfAxis(const Effects& effects, const Axis& axis) {
  std::vector<EffectFault> faults;
  for (const Effect& effect : effects) {
    const std::string_view id = effect.mechanism->id;
    if (ShapesRate(*effect.mechanism) && !axis.undriven.empty()) {
      faults.push_back({id, fmt::format("shapes a commanded rate, but {}", axis.undriven)});
    }
    if (id == "sag" && axis.max_effort_nm <= 0) {
      faults.push_back({id, fmt::format("is stated at full effort, but {} is 0; need more than 0",
                                        axis.effort_key)});
    }
  }
  if (!axis.undriven.empty()) return faults;
  const auto add = [&](std::string_view id, const std::string& finding) {
    if (!finding.empty()) faults.push_back({id, finding});
  };
  if (FindEffect(effects, "dead_band")) add("dead_band", FaultOfDeadBand(LeverMapOf(effects)));
  if (FindEffect(effects, "pressure_droop")) add("pressure_droop", FaultOfDroop(effects, axis));
  if (FindEffect(effects, "drive_friction"))
    add("drive_friction", FaultOfDriveFriction(effects, axis));
  return faults;
}

/// Adds the fault of a learned effect on an undriven axis.
void AddLearned(const MachineModel& model, std::size_t axis, const std::string& undriven,
                std::vector<EffectFault>* faults) {
  if (undriven.empty() || LearnedAt(model.effects, axis) == nullptr) return;
  faults->push_back({"learned", fmt::format("shapes a commanded rate, but {}", undriven)});
}

std::string FaultOfCylinderLever(const MachineModel& model, std::size_t joint,
                                 const Effect& lever) {
  const Joint& j = model.joints[joint];
  if (j.type == JointType::kPrismatic) {
    return "is of a joint that turns, this one slides; take it away";
  }
  const bool barrel = lever["barrel_m"] > 0, rod = lever["rod_m"] > 0;
  if (barrel != rod) return "needs both barrel_m and rod_m, or neither";
  const KinematicGainParameters gain = GainOf(model, joint);
  if (!rod && (gain.arms_m.values.empty() || j.lower_rad >= j.upper_rad)) {
    return "needs barrel_m and rod_m, as no cylinder of the machine moves the joint between stops";
  }
  if (!rod && lever["angle_at_zero_rad"] != 0) {
    return "takes its angles from the machine's own cylinder; angle_at_zero_rad needs barrel_m and "
           "rod_m beside it";
  }
  if (!rod && (lever["reference_rad"] < j.lower_rad || lever["reference_rad"] > j.upper_rad)) {
    return fmt::format(
        "has its reference_rad beyond the joint's stops, where its cylinder has no lever arm; need "
        "{:.4g} to {:.4g} rad",
        j.lower_rad, j.upper_rad);
  }
  if (KinematicGain(gain).reference_arm_m() < kLeastArm_m) {
    return "has its reference_rad at a dead centre, where the rate has no bound; need another";
  }
  return "";
}

}  // namespace

std::string WhyGearUndriven(const MachineModel& model, std::size_t gear) {
  const bool has_lever =
      std::any_of(model.levers.begin(), model.levers.end(),
                  [&](const Lever& lever) { return lever.gear == static_cast<int>(gear); });
  const GearDrive& drive = model.gear_drives[gear];
  return WhyUndriven(has_lever, drive.max_rate_radps, drive.max_torque_nm, "max_torque_nm");
}

std::vector<EffectFault> FaultsOfJoint(const MachineModel& model, std::size_t joint) {
  const Joint& j = model.joints[joint];
  const Effects& effects = EffectsAt(model.effects.joints, joint);
  std::vector<EffectFault> faults = FaultsOfAxis(
      effects, {WhyJointUndriven(model, joint), j.max_rate_positive_radps,
                j.max_rate_negative_radps, j.max_effort_nm, EffortKey(j), EffortOf(model, joint)});
  AddLearned(model, joint, WhyJointUndriven(model, joint), &faults);
  const bool stops = j.type != JointType::kContinuous && j.lower_rad < j.upper_rad;
  if (FindEffect(effects, "end_cushion") && !stops) {
    faults.push_back({"end_cushion",
                      "slows a joint near its end stops, which this one has not; need limits_deg"});
  }
  if (const Effect* gain = FindEffect(effects, "asymmetric_gain");
      gain && j.max_rate_positive_radps > 0 && j.max_rate_negative_radps <= 0) {
    faults.push_back({"asymmetric_gain",
                      "changes negative rates, of which this joint has none; need a "
                      "max_rate_degps for both directions"});
  }
  if (const Effect* lever = FindEffect(effects, "cylinder_lever")) {
    const std::string fault = FaultOfCylinderLever(model, joint, *lever);
    if (!fault.empty()) faults.push_back({"cylinder_lever", fault});
  }
  return faults;
}

std::vector<EffectFault> FaultsOfGear(const MachineModel& model, std::size_t gear) {
  const GearDrive& drive = model.gear_drives[gear];
  const std::size_t axis = model.joints.size() + gear;
  std::vector<EffectFault> faults =
      FaultsOfAxis(EffectsAt(model.effects.gears, gear),
                   {WhyGearUndriven(model, gear), drive.max_rate_radps, drive.max_rate_radps,
                    drive.max_torque_nm, "max_torque_nm", EffortOf(model, axis)});
  AddLearned(model, axis, WhyGearUndriven(model, gear), &faults);
  return faults;
}

std::vector<EffectFault> FaultsOfPump(const MachineModel& model, std::size_t pump) {
  const Pump& p = model.pumps[pump];
  const bool feeds =
      std::any_of(
          p.joints.begin(), p.joints.end(),
          [&](int j) { return WhyJointUndriven(model, static_cast<std::size_t>(j)).empty(); }) ||
      std::any_of(p.gears.begin(), p.gears.end(), [&](int g) {
        return WhyGearUndriven(model, static_cast<std::size_t>(g)).empty();
      });
  std::vector<EffectFault> faults;
  if (feeds) return faults;
  for (const Effect& effect : EffectsAt(model.effects.pumps, pump)) {
    faults.push_back({effect.mechanism->id,
                      fmt::format("shares out what levers ask of pump '{}', but none drives any "
                                  "that it feeds; need one with a lever, a rate and an effort",
                                  p.name)});
  }
  return faults;
}

}  // namespace tera
