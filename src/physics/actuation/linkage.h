#pragma once

#include <optional>

#include "physics/description/machine.h"

/// Poses of cylinders and four-bar linkages at a joint's position, and the oil volume of a motion.
/// Geometry alone, no state.

namespace tera {

/// Poses of a four-bar's parts in its joint's parent link P.
struct FourBarPose {
  Pose X_PR = Pose::Identity();  ///< rocker
  Pose X_PC = Pose::Identity();  ///< coupler
};

/// Solves a four-bar linkage at `q_rad`; nothing where it does not close.
///
/// Model   the knee is the intersection of two circles: about the rocker's pin with the rocker's
///         length, and about the coupler's pin with the coupler's.
std::optional<FourBarPose> SolveFourBar(const MachineModel& model, const FourBar& linkage,
                                        double q_rad);

/// The pose of a linkage that closes at `q_rad`; the caller guarantees it.
FourBarPose PoseOf(const MachineModel& model, const FourBar& linkage, double q_rad);

/// A cylinder's pins in its joint's parent link P, in the middle of parallel cylinders.
struct CylinderPins {
  Vec3 barrel_P_m = Vec3::Zero(), rod_P_m = Vec3::Zero();
};

CylinderPins PinsOf(const MachineModel& model, const Cylinder& cylinder, double q_rad);

/// Length of a cylinder and its derivative by the joint's position.
struct CylinderReach {
  double length_m = 0;  ///< between the pins
  /// d length / d q, metres per radian (or metre): the lever arm of the cylinder's force, positive
  /// where the rod extends as the joint's position grows.
  double arm_m = 0;
};

CylinderReach ReachOf(const MachineModel& model, const Cylinder& cylinder, double q_rad);

/// Piston area of one cylinder, and its annular area around the rod.
double HeadArea_m2(const Cylinder& cylinder);
double RodArea_m2(const Cylinder& cylinder);

/// Oil volume per radian (or metre) of all the joint's cylinders at `q_rad`, in the direction of
/// `sign`; 0 without cylinders that have a bore.
double CylinderDisplacement_m3prad(const MachineModel& model, int joint, double q_rad, int sign);

}  // namespace tera
