#pragma once

#include <vector>

#include "physics/actuation/actuation.h"
#include "physics/actuation/hydraulics.h"
#include "physics/description/machine_placement.h"
#include "physics/dynamics/articulated_body.h"
#include "physics/dynamics/inertial_effort.h"
#include "physics/traction/track_drive.h"

class btMultiBodyDynamicsWorld;

namespace tera {

/// A machine at rest at its placement; link poses are not set.
MachineState InitialState(const MachinePlacement& placement);

/// Levers, drives and running gear of one machine with its articulated body.
///
/// Model   levers -> Actuation -> rates and friction of joints and gears. Gears turn against the
///         soil's traction, I dw/dt = torque - traction * radius. On a driven base the drive's
///         force replaces the traction, and gears turn at the commanded rate under any load. A
///         wheel's joint turns with its gear, with unlimited effort.
/// Omits   the reaction of a gear's inertia on its link.
class MachineDynamics {
 public:
  /// `world` must outlive the machine.
  MachineDynamics(const MachinePlacement& placement, const WorldStart& start, bool meets_others,
                  btMultiBodyDynamicsWorld* world);
  // Members refer to the machine's model.
  MachineDynamics(const MachineDynamics&) = delete;
  MachineDynamics& operator=(const MachineDynamics&) = delete;

  /// Prepares the world's next step of `dt_s` and turns the gears.
  void Act(const MachineInput& input, double dt_s, MachineState* state);
  /// Reads the results of a step; dt_s = 0 reads the initial state.
  void Read(double dt_s, MachineState* state);

 private:
  /// Sets the lever of each axis, joints first, then gears.
  void Command(const std::vector<double>& levers, MachineState* state);
  /// Computes the chain from levers to drives at the axes' positions. `traction_n` is the traction
  /// of the last step, like the efforts and accelerations of `state`.
  void Actuate(const std::vector<double>& traction_n, double dt_s, const MachineState& state);
  /// Loads of all axes: their efforts in the last step minus the inertial part.
  void MeasureLoads(const std::vector<double>& traction_n, const MachineState& state);
  void DriveJoints(double dt_s, const MachineState& state);
  void TurnGears(const SoilReaction& soil, double dt_s, MachineState* state);
  /// Reaction of the ground on the gears of a driven base, which replaces the soil's shear.
  SoilReaction OnDrivenBase(const SoilReaction& soil, double dt_s, const MachineState& state) const;
  /// Torque of a ground force on a gear; 0 without a force.
  double GearTorque_nm(const std::vector<double>& traction_n, std::size_t gear) const;

  MachineModel model_;
  TrackDrive tracks_;
  ArticulatedBody body_;
  Hydraulics hydraulics_;
  Actuation actuation_;
  InertialEfforts inertial_;
  std::vector<double> resting_nm_;       ///< load of each joint at rest; empty after the first step
  std::vector<double> last_traction_n_;  ///< the soil's traction on each gear
  std::vector<double> axis_lever_;
  std::vector<AxisMotion> axis_motion_;
  std::vector<JointTarget> joint_target_;
  std::vector<double> start_rad_;  ///< initial position of each joint
};

}  // namespace tera
