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

/// A machine at rest where it is placed, its links' poses still to be read.
MachineState InitialState(const MachinePlacement& placement);

/// Levers, drives and running gear of one machine around its articulated body.
///
/// Model   levers -> Actuation -> rates and friction of joints and gears. Gears turn against the
///         soil's traction, I dw/dt = torque - traction * radius; with a driven base against the
///         drive's force, as commanded whatever that is. A wheel's joint turns with its gear,
///         whatever that takes.
/// Omits   the reaction of a gear's inertia on its link.
class MachineDynamics {
 public:
  /// `world` must outlive the machine.
  MachineDynamics(const MachinePlacement& placement, const WorldStart& start, bool meets_others,
                  btMultiBodyDynamicsWorld* world);
  // Parts of it refer to its model.
  MachineDynamics(const MachineDynamics&) = delete;
  MachineDynamics& operator=(const MachineDynamics&) = delete;

  /// Prepares the world's next step of `dt_s` and turns the gears.
  void Act(const MachineInput& input, double dt_s, MachineState* state);
  /// What came of a step; 0 for none.
  void Read(double dt_s, MachineState* state);

 private:
  /// The lever of each axis, joints first, then gears.
  void Command(const std::vector<double>& levers, MachineState* state);
  /// The chain from levers to drives, from where the axes are; `traction_n` is that of the last
  /// step, as the efforts and accelerations of `state` are.
  void Actuate(const std::vector<double>& traction_n, double dt_s, const MachineState& state);
  /// The loads of all axes: their efforts in the last step without what accelerated masses.
  void MeasureLoads(const std::vector<double>& traction_n, const MachineState& state);
  void DriveJoints(double dt_s, const MachineState& state);
  void TurnGears(const SoilReaction& soil, double dt_s, MachineState* state);
  /// What the ground does to the gears when the base is driven instead of sheared along.
  SoilReaction OnDrivenBase(const SoilReaction& soil, double dt_s, const MachineState& state) const;
  /// Torque of a force of the ground on a gear, 0 where none is given.
  double GearTorque_nm(const std::vector<double>& traction_n, std::size_t gear) const;

  MachineModel model_;
  TrackDrive tracks_;
  ArticulatedBody body_;
  Hydraulics hydraulics_;
  Actuation actuation_;
  InertialEfforts inertial_;
  std::vector<double> resting_nm_;  ///< load of each joint before the first step, empty after it
  std::vector<double> last_traction_n_;  ///< of each gear by the soil
  std::vector<double> axis_lever_;
  std::vector<AxisMotion> axis_motion_;
  std::vector<JointTarget> joint_target_;
  std::vector<double> start_rad_;  ///< of each joint
};

}  // namespace tera
