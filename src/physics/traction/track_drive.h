#pragma once

#include <vector>

#include "physics/description/machine.h"
#include "physics/traction/track_kinematics.h"

namespace tera {

/// Sets the ratio of each gear between shoes and sprockets, from the base effects track_scale and
/// track_asymmetry.
void SetShoeRatios(MachineModel* model);

/// The running gear of a machine as two tracks, for the slot `ground`.
///
/// Frames  B root link.
/// Model   Gears left of B's x axis form the left track, the others the right track. Several gears
///         on one side move with their mean rate. The force of the drive is limited by two terms:
///         the shear strength of the ground under the gears, and the motors less the rolling
///         resistance. Its torque is limited to the shear strength times half the gauge. The
///         ground's force on a side is half the force of the drive, plus or minus its torque over
///         the gauge.
/// Omits   Different grip on the two sides.
class TrackDrive {
 public:
  explicit TrackDrive(const MachineModel& model);

  /// Centre of the contact with the ground.
  const Vec3& contact_B_m() const { return contact_B_m_; }
  const TrackGeometry& geometry() const { return geometry_; }
  /// True if the slips among the effects leave a nonzero speed on level ground.
  bool MovesOnLevelGround() const;

  struct Target {
    PlanarTwist twist;
    BaseEffort most;
  };
  /// Commanded motion of the base and its effort limits, from the gear rates in `state`.
  Target Follow(const MachineState& state, const SoilReaction& soil) const;
  /// Converts a wrench about the root's origin to the centre of the contact.
  BaseEffort AboutContact(const Wrench& wrench, const Pose& X_WB) const;
  /// Share of a gear in a force and a torque about the centre of the contact.
  double Share_n(const BaseEffort& effort, std::size_t gear) const;
  /// Ground force on each gear along its forward travel if the drive applies `effort`.
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
