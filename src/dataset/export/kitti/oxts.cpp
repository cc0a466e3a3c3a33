#include "dataset/export/kitti/oxts.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/units.h"
#include "dataset/format/site_frame.h"

namespace tera {
namespace {

constexpr TimeNs kLeastHalfWindow_ns = 10'000'000;
constexpr int kLocked = 4;  ///< navigation status of a complete solution

std::string Numbers(const Vec3& v) {
  return fmt::format(" {:.12f} {:.12f} {:.12f}", v.x(), v.y(), v.z());
}

}  // namespace

BodyMotion MotionAt(const SensorPoses& poses, const Pose& X_SB, TimeNs t_ns) {
  const auto X_WB = [&](TimeNs at_ns) { return poses.X_WS.At(at_ns) * X_SB; };
  BodyMotion motion;
  motion.X_WB = X_WB(t_ns);
  const TimeNs half_ns = std::min(std::max(kLeastHalfWindow_ns, poses.MeanPeriod_ns()),
                                  (poses.last_ns - poses.first_ns) / 2);
  if (half_ns == 0) return motion;
  const TimeNs middle_ns = std::clamp(t_ns, poses.first_ns + half_ns, poses.last_ns - half_ns);
  const Pose before = X_WB(middle_ns - half_ns), after = X_WB(middle_ns + half_ns);
  const double half_s = ToSeconds(half_ns);
  motion.a_W_mps2 =
      (before.translation() - 2 * X_WB(middle_ns).translation() + after.translation()) /
      (half_s * half_s);
  motion.v_W_mps = (after.translation() - before.translation()) / (2 * half_s) +
                   motion.a_W_mps2 * ToSeconds(t_ns - middle_ns);
  const Eigen::AngleAxisd turn(before.linear().transpose() * after.linear());
  motion.w_B_radps = turn.axis() * turn.angle() / (2 * half_s);
  return motion;
}

std::string OxtsRow(const BodyMotion& motion, const DatasetInfo& info) {
  const SiteFrame site(info.origin_lat_deg, info.origin_lon_deg, info.origin_height_m);
  const SiteFrame::Geodetic place = site.ToGeodetic(motion.X_WB.translation());
  const Vec3 rpy_rad = RpyFromRotation(motion.X_WB.linear());
  const Mat3 R_BW = motion.X_WB.linear().transpose();
  // L: levelled frame with x forward
  const Mat3 R_LW = RotationFromRpy(0, 0, rpy_rad.z()).transpose();
  const Vec3 f_W_mps2 = motion.a_W_mps2 + Vec3(0, 0, kStandardGravity_mps2);
  const Vec3 w_W_radps = motion.X_WB.linear() * motion.w_B_radps;
  std::string row =
      fmt::format("{:.12f} {:.12f} {:.9f}", place.lat_deg, place.lon_deg, place.height_m);
  row += Numbers(rpy_rad);
  row += fmt::format(" {:.12f} {:.12f}", motion.v_W_mps.y(), motion.v_W_mps.x());
  row += Numbers(R_LW * motion.v_W_mps);
  row += Numbers(R_BW * f_W_mps2) + Numbers(R_LW * f_W_mps2);
  row += Numbers(motion.w_B_radps) + Numbers(R_LW * w_W_radps);
  return row + fmt::format(" 0 0 {} 0 0 0 0\n", kLocked);
}

}  // namespace tera
