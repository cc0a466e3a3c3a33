#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "physics/actuation/actuator_dynamics.h"
#include "physics/actuation/command_timing.h"
#include "physics/actuation/kinematic_gain.h"
#include "physics/actuation/learned_rate.h"
#include "physics/actuation/lever_map.h"
#include "physics/actuation/load_friction.h"
#include "physics/actuation/over_travel.h"
#include "physics/actuation/pump_flow.h"
#include "physics/description/machine.h"

/// The chain from levers to joints and gears: command_timing, lever_map, flow, actuator,
/// kinematic_gain, load_friction, learned effect. docs/reference/mechanisms.md describes each
/// mechanism.

namespace tera {

/// Parameters of all slots of one joint or gear. Units are radians and newton metres; for a
/// prismatic joint they are metres and newtons.
struct AxisParameters {
  double max_rate_positive_radps = 0, max_rate_negative_radps = 0;
  /// Oil volume per radian for motion in either direction, as a function of the joint's position.
  OverTravel displacement_positive_m3prad{.values = {0}},
      displacement_negative_m3prad{.values = {0}};
  CommandTimingParameters timing;
  LeverMapParameters map;
  ActuatorParameters actuator;
  KinematicGainParameters gain;
  LoadFrictionParameters load;
};

/// Simulated or measured state of an axis at the start of a step. The load is the effort of a
/// steady rate without the friction of the axis. It excludes the effort that accelerates the masses
/// of the axis and, for tracks, of the whole machine.
struct AxisMotion {
  double position_rad = 0, rate_radps = 0, load_nm = 0;
};

/// Demand of the chain on an axis over a step, with friction and offset.
struct AxisDrive {
  double rate_radps = 0;
  AxisFriction friction;
  double offset_nm = 0;  ///< constant effort that the actuator must also supply
};

/// The chain of one axis in two parts: before and after the pumps share their flow.
class AxisActuation {
 public:
  AxisActuation(const AxisParameters& parameters, const Stream& drops, std::int64_t first_step);

  /// Rate demanded by `lever`, -1..+1, during a step.
  double Demand(double lever, double dt_s);
  /// Oil flow and power that `rate_radps` demands of the pumps.
  ///
  /// Model   Oil is the motion of the piston at the position where the kinematic gain is 1. Power
  ///         is the load times the joint's rate, gain included.
  double Flow_m3ps(double rate_radps, double position_rad) const;
  double Power_w(double rate_radps, const AxisMotion& motion) const;
  bool ReadsLoad() const { return load_.ReadsLoad(); }
  /// Response of the axis to `rate_radps`, the part of the demand that the pumps deliver.
  /// DeliveredRate returns the rate alone; Deliver adds friction and offset.
  double DeliveredRate(double rate_radps, const AxisMotion& motion, double dt_s);
  AxisDrive Deliver(double rate_radps, const AxisMotion& motion, double dt_s);

 private:
  AxisParameters parameters_;
  CommandTiming timing_;
  ActuatorDynamics actuator_;
  KinematicGain gain_;
  LoadFriction load_;
};

/// Start of a chain: time and random streams.
struct ActuationStart {
  std::string machine;  ///< prefix of the names of the streams
  std::uint64_t seed = 1;
  std::int64_t step = 0;  ///< index of the first step
};

/// Effects of target k; empty if the list is too short.
const Effects& EffectsAt(const std::vector<Effects>& effects, std::size_t k);

/// The kinematic gain of a joint from its effects. If `cylinder_lever` names no pins, the lever
/// arms are those of the machine's own cylinder.
KinematicGainParameters GainOf(const MachineModel& model, std::size_t joint);

/// Greatest effort of an axis (joints first, then gears) over its travel: that of its cylinders at
/// relief pressure, or else max_effort_nm.
ActuatorEffort EffortOf(const MachineModel& model, std::size_t axis);

/// The chain of one axis (joints first, then gears), without the pumps.
AxisActuation AxisActuationOf(const MachineModel& model, std::size_t axis,
                              const ActuationStart& start);

/// The chain of a whole machine: joints first, then gears, in the order of the model.
///
/// Model   A pump delivers the same share of the demand to all its axes. An axis with several pumps
///         demands equal parts of them. All quantities come from the state at the start of the
///         step, so the order of axes has no effect.
class Actuation {
 public:
  Actuation(const MachineModel& model, const ActuationStart& start);

  /// `levers` and `motions` have one entry for each axis, not for each lever of the model. `dt_s`
  /// is the same in every step.
  void Step(std::span<const double> levers, std::span<const AxisMotion> motions, double dt_s);

  /// True if any mechanism depends on the loads; otherwise Step does not read them.
  bool reads_loads() const { return reads_loads_; }
  /// Demands of the last step, one for each axis.
  const std::vector<AxisDrive>& drives() const { return drives_; }

 private:
  struct PumpState {
    PumpFlow flow;
    std::vector<std::size_t> axes;
    double share = 1;
  };

  void AddPumps(const MachineModel& model);
  void ShareFlow(std::span<const AxisMotion> motions, double dt_s);
  void ApplyLearned(std::span<const double> levers, std::span<const AxisMotion> motions,
                    double dt_s);

  std::vector<AxisActuation> axes_;
  std::vector<std::optional<LearnedRate>> learned_;  ///< one for each axis
  std::int64_t step_ = 0;
  std::vector<PumpState> pumps_;
  std::vector<int> pump_count_;  ///< for each axis: number of pumps that feed it
  bool reads_loads_ = false;
  std::vector<double> demand_radps_;
  std::vector<AxisDrive> drives_;
};

}  // namespace tera
