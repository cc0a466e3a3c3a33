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

/// The chain from levers to joints and gears: command_timing -> lever_map -> flow -> actuator ->
/// kinematic_gain -> load_friction -> what was learned. docs/reference/mechanisms.md describes each
/// mechanism.

namespace tera {

/// One joint or gear with what each of its slots has. Its units are radians and newton metres, or
/// metres and newtons for a joint that slides.
struct AxisParameters {
  double max_rate_positive_radps = 0, max_rate_negative_radps = 0;
  /// Oil taken for one radian in either direction, at the joint's position.
  OverTravel displacement_positive_m3prad{.values = {0}},
      displacement_negative_m3prad{.values = {0}};
  CommandTimingParameters timing;
  LeverMapParameters map;
  ActuatorParameters actuator;
  KinematicGainParameters gain;
  LoadFrictionParameters load;
};

/// Where an axis is at the start of a step, simulated or measured. The load is the effort that it
/// needs at a steady rate, beside that against its own friction: what accelerates masses, its own
/// or with tracks the whole machine's, is none.
struct AxisMotion {
  double position_rad = 0, rate_radps = 0, load_nm = 0;
};

/// What the chain asks of an axis over a step, and what acts on it beside its load.
struct AxisDrive {
  double rate_radps = 0;
  AxisFriction friction;
  double offset_nm = 0;  ///< constant effort that the actuator must make up for
};

/// The chain of one axis in two parts, between which pumps share their flow.
class AxisActuation {
 public:
  AxisActuation(const AxisParameters& parameters, const Stream& drops, std::int64_t first_step);

  /// Rate asked for by `lever`, -1..+1, during a step.
  double Demand(double lever, double dt_s);
  /// Oil and power that `rate_radps` asks of the pumps.
  ///
  /// Model   oil is what the piston moves, at the rate that a position with the kinematic gain 1
  ///         has; power is the load times the rate of the joint, gain included.
  double Flow_m3ps(double rate_radps, double position_rad) const;
  double Power_w(double rate_radps, const AxisMotion& motion) const;
  bool ReadsLoad() const { return load_.ReadsLoad(); }
  /// What comes of `rate_radps`, the share of the demand that the pumps deliver; the rate alone, or
  /// with all else that acts on the axis.
  double DeliveredRate(double rate_radps, const AxisMotion& motion, double dt_s);
  AxisDrive Deliver(double rate_radps, const AxisMotion& motion, double dt_s);

 private:
  AxisParameters parameters_;
  CommandTiming timing_;
  ActuatorDynamics actuator_;
  KinematicGain gain_;
  LoadFriction load_;
};

/// What tells apart the random numbers of machines and runs, and when the chain starts.
struct ActuationStart {
  std::string machine;  ///< names the streams
  std::uint64_t seed = 1;
  std::int64_t step = 0;  ///< time is this many steps at the first one
};

/// Effects of the k-th of several; none where a model without effects has no lists.
const Effects& EffectsAt(const std::vector<Effects>& effects, std::size_t k);

/// The kinematic gain of a joint by its effects, with the arms of the machine's own cylinder where
/// `cylinder_lever` names no pins.
KinematicGainParameters GainOf(const MachineModel& model, std::size_t joint);

/// What drives an axis (joints first, then gears) over its travel: what relief lets the joint's
/// cylinders do, or else its own largest effort.
ActuatorEffort EffortOf(const MachineModel& model, std::size_t axis);

/// The chain of one axis of a machine (joints first, then gears), without the pumps.
AxisActuation AxisActuationOf(const MachineModel& model, std::size_t axis,
                              const ActuationStart& start);

/// The chain of a whole machine: joints first, then gears, each in the model's order.
///
/// Model   Every pump delivers one share to all that it feeds; an axis fed by several pumps asks
///         each for the same part. Everything follows from the state at the start of the step, so
///         the order of axes is without effect.
class Actuation {
 public:
  Actuation(const MachineModel& model, const ActuationStart& start);

  /// `levers` one for each axis (not each lever of the model), `motions` one for each axis, `dt_s`
  /// the same in every step.
  void Step(std::span<const double> levers, std::span<const AxisMotion> motions, double dt_s);

  /// Whether anything in it depends on the loads; without, Step does not look at them.
  bool reads_loads() const { return reads_loads_; }
  /// What the last step asks of each axis.
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
  std::vector<int> pump_count_;  ///< of each axis
  bool reads_loads_ = false;
  std::vector<double> demand_radps_;
  std::vector<AxisDrive> drives_;
};

}  // namespace tera
