#pragma once

#include <optional>

#include "physics/description/machine.h"

/// Geometry of cylinders and four-bar linkages at a joint's position, and the oil volume of a
/// motion. There is no state.

namespace tera {

/// Poses of the parts of a four-bar linkage in the parent link P of its joint.
struct FourBarPose {
  Pose X_PR = Pose::Identity();  ///< rocker
  Pose X_PC = Pose::Identity();  ///< coupler
};

/// Solves a four-bar linkage at `q_rad`; empty if it does not close.
///
/// Model   The knee is the intersection of two circles: about the rocker's pin with the rocker's
///         length, and about the coupler's pin with the coupler's length.
std::optional<FourBarPose> SolveFourBar(const MachineModel& model, const FourBar& linkage,
                                        double q_rad);

/// The pose of a linkage that is known to close at `q_rad`.
FourBarPose PoseOf(const MachineModel& model, const FourBar& linkage, double q_rad);

/// Pins of a cylinder in the parent link P of its joint; the middle of parallel cylinders.
struct CylinderPins {
  Vec3 barrel_P_m = Vec3::Zero(), rod_P_m = Vec3::Zero();
};

CylinderPins PinsOf(const MachineModel& model, const Cylinder& cylinder, double q_rad);

/// Length of a cylinder and its derivative with respect to the joint's position.
struct CylinderReach {
  double length_m = 0;  ///< distance between the pins
  /// d length / d q in metres per radian (or metre): the lever arm of the cylinder's force. It is
  /// positive if the rod extends as q grows.
  double arm_m = 0;
};

CylinderReach ReachOf(const MachineModel& model, const Cylinder& cylinder, double q_rad);

/// Piston area of one cylinder, and its annular area around the rod.
double HeadArea_m2(const Cylinder& cylinder);
double RodArea_m2(const Cylinder& cylinder);

/// Oil volume per radian (or metre) of all cylinders of a joint at `q_rad`, for motion in the
/// direction `sign`. It is 0 without cylinders that have a bore.
double CylinderDisplacement_m3prad(const MachineModel& model, int joint, double q_rad, int sign);

}  // namespace tera
