#include "sim/operators/planar_arm.h"

#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

double PitchOf(const Vec3& direction) {
  return std::atan2(direction.z(),
                    std::hypot(direction.x(), direction.y()) * (direction.x() < 0 ? -1.0 : 1.0));
}

}  // namespace

PlanarArm::PlanarArm(const MachineModel& model, const Joints& joints, int tip_frame) {
  const Joint& boom = model.joints[joints.boom];
  const Joint& arm = model.joints[joints.arm];
  const Joint& bucket = model.joints[joints.bucket];
  const NamedFrame& tip = model.frames[tip_frame];
  TERA_CHECK(arm.parent == boom.child && bucket.parent == arm.child && tip.link == bucket.child);

  // Poses with all joints at zero and the root level at the origin.
  const std::vector<Pose> X_WB =
      ForwardKinematics(model, Pose::Identity(), std::vector<double>(model.joints.size(), 0.0));
  const Pose X_UW = X_WB[model.joints[joints.slew].child].inverse();
  const Vec3 foot = X_UW * X_WB[boom.child].translation();
  const Vec3 elbow = X_UW * X_WB[arm.child].translation();
  const Vec3 wrist = X_UW * X_WB[bucket.child].translation();
  const Vec3 point = X_UW * (X_WB[tip.link] * tip.X_BF.translation());
  boom_foot_m_ = {foot.x(), foot.z()};
  boom_length_m_ = (elbow - foot).norm();
  arm_length_m_ = (wrist - elbow).norm();
  bucket_length_m_ = (point - wrist).norm();
  bucket_offset_rad_ = PitchOf(point - wrist);
}

std::optional<PlanarArm::Angles> PlanarArm::Inverse(const Tip& tip) const {
  const Vec2 wrist(tip.r_m - bucket_length_m_ * std::cos(tip.pitch_rad) - boom_foot_m_.x(),
                   tip.z_m - bucket_length_m_ * std::sin(tip.pitch_rad) - boom_foot_m_.y());
  const double a = boom_length_m_, b = arm_length_m_, d2 = wrist.squaredNorm();
  const double cos_elbow = (d2 - a * a - b * b) / (2 * a * b);
  if (std::abs(cos_elbow) > 1.0) return std::nullopt;
  const double arm = -std::acos(cos_elbow);  // elbow up: the arm folds downward
  const double boom =
      std::atan2(wrist.y(), wrist.x()) - std::atan2(b * std::sin(arm), a + b * std::cos(arm));
  return Angles{boom, arm, tip.pitch_rad - boom - arm - bucket_offset_rad_};
}

PlanarArm::Tip PlanarArm::Forward(const Angles& angles) const {
  const double arm_pitch = angles.boom_rad + angles.arm_rad;
  const double pitch = arm_pitch + angles.bucket_rad + bucket_offset_rad_;
  return {boom_foot_m_.x() + boom_length_m_ * std::cos(angles.boom_rad) +
              arm_length_m_ * std::cos(arm_pitch) + bucket_length_m_ * std::cos(pitch),
          boom_foot_m_.y() + boom_length_m_ * std::sin(angles.boom_rad) +
              arm_length_m_ * std::sin(arm_pitch) + bucket_length_m_ * std::sin(pitch),
          pitch};
}

}  // namespace tera
