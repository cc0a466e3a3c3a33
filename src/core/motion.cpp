#include "core/motion.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {

Mat3 RotationFromRpy(double roll_rad, double pitch_rad, double yaw_rad) {
  return (Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Vec3::UnitY()) *
          Eigen::AngleAxisd(roll_rad, Vec3::UnitX()))
      .toRotationMatrix();
}

Vec3 RpyFromRotation(const Mat3& R) {
  const double pitch = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  if (std::abs(R(2, 0)) > 1.0 - 1e-12) return {0.0, pitch, std::atan2(-R(0, 1), R(1, 1))};
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

Pose MakePose(const Vec3& p_m, double roll_rad, double pitch_rad, double yaw_rad) {
  return MakePose(p_m, RotationFromRpy(roll_rad, pitch_rad, yaw_rad));
}

Pose MakePose(const Vec3& p_m, const Mat3& R) {
  Pose X = Pose::Identity();
  X.linear() = R;
  X.translation() = p_m;
  return X;
}

Pose Interpolate(const Pose& a, const Pose& b, double s) {
  const Quat q = Quat(a.linear()).slerp(s, Quat(b.linear()));
  return MakePose((1.0 - s) * a.translation() + s * b.translation(), q.toRotationMatrix());
}

Vec3 PointVelocity(const BodyState& body, const Vec3& p_B_m) {
  return body.v_WB_mps + body.w_WB_radps.cross(body.X_WB.linear() * p_B_m);
}

BodyState MotionOfFixedFrame(const BodyState& body, const Pose& X_BS) {
  const Vec3 r_W = body.X_WB.linear() * X_BS.translation();
  const Vec3& w = body.w_WB_radps;
  BodyState s;
  s.X_WB = body.X_WB * X_BS;
  s.v_WB_mps = body.v_WB_mps + w.cross(r_W);
  s.w_WB_radps = w;
  s.a_WB_mps2 = body.a_WB_mps2 + body.alpha_WB_radps2.cross(r_W) + w.cross(w.cross(r_W));
  s.alpha_WB_radps2 = body.alpha_WB_radps2;
  return s;
}

BodyState Interpolate(const BodyState& a, const BodyState& b, double s) {
  BodyState m = b;
  m.X_WB = Interpolate(a.X_WB, b.X_WB, s);
  m.v_WB_mps = (1.0 - s) * a.v_WB_mps + s * b.v_WB_mps;
  m.w_WB_radps = (1.0 - s) * a.w_WB_radps + s * b.w_WB_radps;
  return m;
}

void Wrench::AddForceAt(const Vec3& force_n, const Vec3& p_W_m, const Vec3& origin_W_m) {
  force_W_n += force_n;
  torque_W_nm += (p_W_m - origin_W_m).cross(force_n);
}

void PoseTrack::Append(TimeNs t_ns, const Pose& X_WB) {
  TERA_CHECK(samples_.empty() || t_ns > samples_.back().t_ns, t_ns, samples_.back().t_ns);
  samples_.push_back({t_ns, X_WB});
}

void PoseTrack::DropBefore(TimeNs t_ns) {
  const auto after = std::upper_bound(samples_.begin(), samples_.end(), t_ns,
                                      [](TimeNs t, const Sample& s) { return t < s.t_ns; });
  if (after - samples_.begin() > 1) samples_.erase(samples_.begin(), after - 1);
}

Pose PoseTrack::At(TimeNs t_ns) const {
  TERA_CHECK(!samples_.empty(), t_ns);
  const auto after = std::upper_bound(samples_.begin(), samples_.end(), t_ns,
                                      [](TimeNs t, const Sample& s) { return t < s.t_ns; });
  if (after == samples_.begin()) return samples_.front().X_WB;
  if (after == samples_.end()) return samples_.back().X_WB;
  const auto before = after - 1;
  const double s =
      static_cast<double>(t_ns - before->t_ns) / static_cast<double>(after->t_ns - before->t_ns);
  return Interpolate(before->X_WB, after->X_WB, s);
}

}  // namespace tera
