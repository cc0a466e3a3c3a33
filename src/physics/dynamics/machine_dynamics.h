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

/// State of a machine at rest at its placement, without link poses.
MachineState InitialState(const MachinePlacement& placement);

/// Levers, drives and running gear of one machine with its articulated body.
///
/// Model   Levers -> Actuation -> rates and friction of joints and gears. Gears turn against the
///         traction of the soil: I dw/dt = torque - traction * radius. On a driven base, the force
///         of the drive replaces the traction, and gears turn at the commanded rate under any load.
///         The joint of a wheel turns with its gear, with unlimited effort.
/// Omits   The reaction of a gear's inertia on its link.
class MachineDynamics {
 public:
  /// `world` must outlive the machine.
  MachineDynamics(const MachinePlacement& placement, const WorldStart& start, bool meets_others,
                  btMultiBodyDynamicsWorld* world);
  // Not copyable: members refer to model_.
  MachineDynamics(const MachineDynamics&) = delete;
  MachineDynamics& operator=(const MachineDynamics&) = delete;

  /// Prepares the next step of the world, of length `dt_s`, and turns the gears.
  void Act(const MachineInput& input, double dt_s, MachineState* state);
  /// Reads the results of a step; dt_s = 0 reads the initial state.
  void Read(double dt_s, MachineState* state);

 private:
  /// Sets the lever of each axis, joints first, then gears.
  void Command(const std::vector<double>& levers, MachineState* state);
  /// Computes the chain from levers to drives at the positions of the axes. `traction_n` is that of
  /// the last step, like the efforts and accelerations of `state`.
  void Actuate(const std::vector<double>& traction_n, double dt_s, const MachineState& state);
  /// Loads of all axes: their efforts in the last step without the inertial part.
  void MeasureLoads(const std::vector<double>& traction_n, const MachineState& state);
  void DriveJoints(double dt_s, const MachineState& state);
  void TurnGears(const SoilReaction& soil, double dt_s, MachineState* state);
  /// The soil's reaction with the force of the base drive as traction, for a driven base.
  SoilReaction OnDrivenBase(const SoilReaction& soil, double dt_s, const MachineState& state) const;
  /// Torque of the ground force on a gear; 0 without a force.
  double GearTorque_nm(const std::vector<double>& traction_n, std::size_t gear) const;

  MachineModel model_;
  TrackDrive tracks_;
  ArticulatedBody body_;
  Hydraulics hydraulics_;
  Actuation actuation_;
  InertialEfforts inertial_;
  std::vector<double> resting_nm_;       ///< load of each joint at rest; empty after the first step
  std::vector<double> last_traction_n_;  ///< traction of the soil on each gear
  std::vector<double> axis_lever_;
  std::vector<AxisMotion> axis_motion_;
  std::vector<JointTarget> joint_target_;
  std::vector<double> start_rad_;  ///< initial position of each joint
};

}  // namespace tera
