#include <fmt/format.h>
#include <gtest/gtest.h>

#include "generated.h"

// Strapdown navigation from the written inertial data alone: it starts on the truth and must stay
// on it.

namespace tera {
namespace {

constexpr const char* kDigging = R"(
name: digging
seed: 3
duration_s: 10
terrain: {size_m: [20, 20], cell_m: 0.05, soil: dirt, relief: {amplitude_m: 0.1, wavelength_m: 6}}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {yaw_deg: 35, joints_deg: {boom: 40, arm: -95, bucket: -20}}
    operator: {type: dig_cycle, dig_azimuth_deg: -8, dump_azimuth_deg: 74}
    rig: {sensors: [
      {name: imu_chassis, type: imu, rate_hz: 200, link: upper, xyz_m: [0.15, -0.29, 0.12], rpy_deg: [5, -8, 20]},
      {name: imu_arm, type: imu, rate_hz: 200, link: arm, xyz_m: [0.19, 0.07, 0.14], rpy_deg: [0, 90, 0]},
      {name: imu_bucket, type: imu, rate_hz: 200, link: bucket, xyz_m: [0.13, 0.15, 0.34], rpy_deg: [-30, 15, 170]}]}
)";

struct NavigationState {
  Mat3 R_WS = Mat3::Identity();
  Vec3 p_WS_m = Vec3::Zero(), v_WS_mps = Vec3::Zero();
};

Mat3 Exp(const Vec3& turn_rad) {
  const double angle_rad = turn_rad.norm();
  if (angle_rad == 0) return Mat3::Identity();
  return Eigen::AngleAxisd(angle_rad, turn_rad / angle_rad).toRotationMatrix();
}

/// Strapdown integration of mean rates and forces, with the two-sample terms for coning and
/// sculling (Savage 1998, J. Guidance 21(1) and 21(2)).
class Strapdown {
 public:
  explicit Strapdown(const NavigationState& start) : state_(start) {}

  void Add(const ImuSample& sample, double T_s) {
    const Vec3 gravity_W_mps2(0, 0, -kStandardGravity_mps2);
    const Vec3 turn_rad = T_s * sample.w_WS_S_radps, push_mps = T_s * sample.f_S_mps2;
    const Vec3 rotated_mps =
        push_mps + 0.5 * turn_rad.cross(push_mps) +
        (last_turn_rad_.cross(push_mps) + last_push_mps_.cross(turn_rad)) / 12.0;
    const Vec3 before_mps = state_.v_WS_mps;
    state_.v_WS_mps += state_.R_WS * rotated_mps + T_s * gravity_W_mps2;
    state_.p_WS_m += 0.5 * T_s * (before_mps + state_.v_WS_mps);
    state_.R_WS *= Exp(turn_rad + last_turn_rad_.cross(turn_rad) / 12.0);
    last_turn_rad_ = turn_rad;
    last_push_mps_ = push_mps;
  }
  const NavigationState& state() const { return state_; }

 private:
  NavigationState state_;
  Vec3 last_turn_rad_ = Vec3::Zero(), last_push_mps_ = Vec3::Zero();
};

NavigationState StartOnTruth(const LinkTruth& truth, const std::string& link, int row,
                             const Pose& X_BS) {
  constexpr double kStep_s = 1e-4;
  const Pose X_WS = truth.LinkPose(link, row) * X_BS;
  const Vec3 later_m = (truth.LinkPose(link, row, kStep_s) * X_BS).translation();
  const Vec3 earlier_m = (truth.LinkPose(link, row, -kStep_s) * X_BS).translation();
  return {X_WS.linear(), X_WS.translation(), (later_m - earlier_m) / (2 * kStep_s)};
}

struct Drift {
  double travelled_m = 0, position_m = 0,
         attitude_rad = 0;  ///< the last two: maxima over all times
};

/// Navigates from the truth at `start_ns` to the end.
Drift DriftOf(const Recording& recording, const LinkTruth& truth, const std::string& imu,
              const std::string& link, TimeNs start_ns) {
  const Pose X_BS = MountOf(recording, "excavator1/" + imu);
  Strapdown navigation(StartOnTruth(truth, link, truth.RowAt(start_ns), X_BS));
  Drift drift;
  TimeNs last_ns = start_ns;
  Vec3 last_m = navigation.state().p_WS_m;
  for (const ImuSample& sample : recording.LoadImu("excavator1/" + imu)) {
    if (sample.t_ns <= start_ns) continue;
    navigation.Add(sample, ToSeconds(sample.t_ns - last_ns));
    last_ns = sample.t_ns;
    const int row = truth.RowAt(sample.t_ns);
    if (row < 0) continue;
    const Pose X_WS = truth.LinkPose(link, row) * X_BS;
    const NavigationState& now = navigation.state();
    drift.travelled_m += (X_WS.translation() - last_m).norm();
    last_m = X_WS.translation();
    drift.position_m = std::max(drift.position_m, (now.p_WS_m - X_WS.translation()).norm());
    drift.attitude_rad = std::max(drift.attitude_rad,
                                  Eigen::AngleAxisd(X_WS.linear().transpose() * now.R_WS).angle());
  }
  return drift;
}

const std::vector<std::pair<std::string, std::string>> kImuOnLink = {
    {"imu_chassis", "upper"}, {"imu_arm", "arm"}, {"imu_bucket", "bucket"}};

TEST(InertialData, IntegratedFromTheTrueStartStaysWithinACentimetreForTenSeconds) {
  const Recording recording = Generated("digging", kDigging);
  const LinkTruth truth(recording, "excavator1", "tb235.yaml");
  for (const auto& [imu, link] : kImuOnLink) {
    const Drift drift = DriftOf(recording, truth, imu, link, 0);
    fmt::print(
        "{:12} travelled {:6.2f} m, position within {:.2f} mm, attitude within {:.2f} mrad\n", imu,
        drift.travelled_m, 1e3 * drift.position_m, 1e3 * drift.attitude_rad);
    EXPECT_LT(drift.position_m, 0.01) << imu;
    EXPECT_LT(drift.attitude_rad, 1e-4) << imu;
    // Without motion of the machine the test would be empty.
    EXPECT_GT(drift.travelled_m, imu == "imu_chassis" ? 0.2 : 5.0) << imu;
  }
}

TEST(InertialData, IntegratedFromTheTrueVelocityAmidMotionStaysWithinACentimetre) {
  const Recording recording = Generated("digging", kDigging);
  const LinkTruth truth(recording, "excavator1", "tb235.yaml");
  for (const auto& [imu, link] : kImuOnLink) {
    for (const double start_s : {1.0, 3.0, 5.5, 6.0, 8.5}) {
      const Drift drift = DriftOf(recording, truth, imu, link, FromSeconds(start_s));
      fmt::print("{:12} from {:.1f} s: position within {:.2f} mm\n", imu, start_s,
                 1e3 * drift.position_m);
      EXPECT_LT(drift.position_m, 0.01) << imu << " from " << start_s << " s";
    }
  }
}

}  // namespace
}  // namespace tera
