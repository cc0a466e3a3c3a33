#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/time.h"

/// Rigid poses and motions in monogram notation. `X_AB` is the pose of frame B in A, so `p_A = X_AB
/// * p_B`. `R_AB` is the rotation of X_AB and `p_AB` its translation. `v_WB` is the velocity of B's
/// origin in W; `w_WB` is the angular velocity of B in W. Both are expressed in W unless the name
/// ends in another frame, as in `w_WB_B`.

namespace tera {

/// Allowed deviation of a stored quaternion's norm from 1. Rounding to text stays within it.
inline constexpr double kQuaternionTolerance = 1e-5;

using Pose = Eigen::Isometry3d;
using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

/// Rotation from roll, pitch, yaw in radians: R = Rz(yaw) Ry(pitch) Rx(roll) (URDF convention).
Mat3 RotationFromRpy(double roll_rad, double pitch_rad, double yaw_rad);

/// Inverse of RotationFromRpy, pitch in [-pi/2, pi/2]. Returns (roll, pitch, yaw) in radians.
Vec3 RpyFromRotation(const Mat3& R);

/// Pose from a translation and roll, pitch, yaw in radians.
Pose MakePose(const Vec3& p_m, double roll_rad = 0, double pitch_rad = 0, double yaw_rad = 0);
Pose MakePose(const Vec3& p_m, const Mat3& R);

/// Pose at fraction s in [0, 1] from `a` to `b`: linear translation, slerp rotation.
Pose Interpolate(const Pose& a, const Pose& b, double s);

/// Motion of a rigid body B at one instant.
///
/// Frames  W world (local ENU), B body. Vectors are expressed in W and refer to B's origin.
/// Model   `a_WB_mps2` and `alpha_WB_radps2` are coordinate accelerations: zero at rest, -g in free
///         fall. They are constant over the physics step that ends at this instant.
struct BodyState {
  Pose X_WB = Pose::Identity();
  Vec3 v_WB_mps = Vec3::Zero();
  Vec3 w_WB_radps = Vec3::Zero();
  Vec3 a_WB_mps2 = Vec3::Zero();
  Vec3 alpha_WB_radps2 = Vec3::Zero();
};

/// Velocity in W of the body-fixed point at `p_B_m`.
Vec3 PointVelocity(const BodyState& body, const Vec3& p_B_m);

/// Motion of a frame S that is fixed to body B at pose X_BS: v + w x r and a + alpha x r + w x (w x
/// r).
BodyState MotionOfFixedFrame(const BodyState& body, const Pose& X_BS);

/// State between the steps `a` and `b`. Pose and velocities are interpolated. Accelerations are
/// those of `b`, because they are constant over the step that ends at `b`.
BodyState Interpolate(const BodyState& a, const BodyState& b, double s);

/// Force and torque on a body, expressed in W. The torque is about the origin of the body frame.
struct Wrench {
  Vec3 force_W_n = Vec3::Zero();
  Vec3 torque_W_nm = Vec3::Zero();

  /// Adds a force, expressed in W, that acts at the point `p_W_m`. `origin_W_m` is the origin of
  /// the body frame.
  void AddForceAt(const Vec3& force_n, const Vec3& p_W_m, const Vec3& origin_W_m);
};

/// Poses of one body, appended in strictly increasing time order.
///
/// Model   Interpolate(Pose, Pose, s) between two samples. A time outside the samples gives the
///         nearest end.
class PoseTrack {
 public:
  void Append(TimeNs t_ns, const Pose& X_WB);
  /// Drops samples that are not needed for queries at or after `t_ns`.
  void DropBefore(TimeNs t_ns);
  Pose At(TimeNs t_ns) const;
  bool empty() const { return samples_.empty(); }

 private:
  struct Sample {
    TimeNs t_ns;
    Pose X_WB;
  };
  std::vector<Sample> samples_;
};

}  // namespace tera
