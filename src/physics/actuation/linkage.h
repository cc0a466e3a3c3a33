#pragma once

#include <optional>

#include "physics/description/machine.h"

/// Where cylinders and four-bar linkages are for a joint's position, and the oil that a motion
/// takes: geometry alone, no state.

namespace tera {

/// Where the parts of a four-bar are in its joint's parent link P.
struct FourBarPose {
  Pose X_PR = Pose::Identity();  ///< rocker
  Pose X_PC = Pose::Identity();  ///< coupler
};

/// Model   the knee is where two circles meet: about the rocker's pin with the rocker's length, and
///         about the coupler's pin with the coupler's.
/// Nothing where the circles do not meet.
std::optional<FourBarPose> SolveFourBar(const MachineModel& model, const FourBar& linkage,
                                        double q_rad);

/// The pose of a linkage that is known to close at `q_rad`.
FourBarPose PoseOf(const MachineModel& model, const FourBar& linkage, double q_rad);

/// A cylinder's pins in the frame P of its joint's parent link, at the middle of those side by
/// side.
struct CylinderPins {
  Vec3 barrel_P_m = Vec3::Zero(), rod_P_m = Vec3::Zero();
};

CylinderPins PinsOf(const MachineModel& model, const Cylinder& cylinder, double q_rad);

/// How long a cylinder is, and how it moves with its joint.
struct CylinderReach {
  double length_m = 0;  ///< between the pins
  /// d length / d q, metres a radian (or a metre): the lever arm of the cylinder's force, positive
  /// where the rod moves out as the joint's position grows.
  double arm_m = 0;
};

CylinderReach ReachOf(const MachineModel& model, const Cylinder& cylinder, double q_rad);

/// Piston area of one cylinder on the side without rod, and around the rod.
double HeadArea_m2(const Cylinder& cylinder);
double RodArea_m2(const Cylinder& cylinder);

/// Oil that all cylinders of the joint take for one radian (or metre) of it at `q_rad`, moving in
/// the direction of `sign`; 0 without cylinders that have a bore.
double CylinderDisplacement_m3prad(const MachineModel& model, int joint, double q_rad, int sign);

}  // namespace tera
