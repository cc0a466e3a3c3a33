#pragma once

#include <vector>

#include "physics/description/machine.h"
#include "physics/traction/track_kinematics.h"

namespace tera {

/// Gives the gears the ratio that track_scale and track_asymmetry among the effects of the base
/// make between their shoes and their sprockets.
void SetShoeRatios(MachineModel* model);

/// A machine's running gear as two tracks, for the ground slot.
///
/// Frames  B root link.
/// Model   Gears left of B's x axis are the left track, the others the right one; several on one
///         side move as their mean. The drive pushes with at most the shear strength of the ground
///         under the gears and what their motors can, less the rolling resistance; it turns with at
///         most the strength times half the gauge. The ground's force on a side is half the drive's
///         force and its torque over the gauge.
/// Omits   grip that one side has and the other lacks.
class TrackDrive {
 public:
  explicit TrackDrive(const MachineModel& model);

  /// Middle of the contact with the ground.
  const Vec3& contact_B_m() const { return contact_B_m_; }
  const TrackGeometry& geometry() const { return geometry_; }
  /// Whether the slips among the effects leave anything of the tracks' speed on level ground.
  bool MovesOnLevelGround() const;

  struct Target {
    PlanarTwist twist;
    BaseEffort most;
  };
  /// What the gears' rates in `state` ask of the base.
  Target Follow(const MachineState& state, const SoilReaction& soil) const;
  /// A wrench about the root's origin as one about the contact's middle.
  BaseEffort AboutContact(const Wrench& wrench, const Pose& X_WB) const;
  /// Part that one gear has in a force and a torque about the contact's middle.
  double Share_n(const BaseEffort& effort, std::size_t gear) const;
  /// Force of the ground on each gear along its forward travel when the drive does `effort`.
  std::vector<double> Traction_n(const BaseEffort& effort, const MachineState& state) const;

 private:
  struct Gear {
    bool left = false;
    double radius_m = 0, max_torque_nm = 0;
  };
  double Resistance_n(const MachineState& state) const;
  TrackCircumstances CircumstancesOf(const MachineState& state, const SoilReaction& soil) const;

  TrackKinematicsParameters parameters_;
  TrackGeometry geometry_;
  std::vector<Gear> gears_;
  std::vector<int> tool_links_;
  double left_count_ = 0, right_count_ = 0;
  Vec3 contact_B_m_ = Vec3::Zero();
};

}  // namespace tera
