#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/random.h"
#include "core/units.h"
#include "diagnose/measurements.h"

// A short recording of a base on a winding path, its upper structure and its boom, by formulas of
// sines. Inertial units on the upper structure and the boom, two antennas, encoders, poses.

namespace tera {

/// Errors, each relative to the documented value. SI units.
struct Wrong {
  Vec3 gyro_bias_radps = Vec3::Zero(), accel_bias_mps2 = Vec3::Zero();  ///< of the boom's unit
  Vec3 mount_rad = Vec3::Zero(), place_m = Vec3::Zero();                ///< of the boom's unit
  Vec3 accel_scale = Vec3::Ones();                                      ///< of the boom's unit
  double unit_late_s = 0;               ///< stamps of the boom's unit
  double unit_low_pass_s = 0;           ///< time constant of the boom's unit
  double gyro_limit_radps = 1e9;        ///< of the boom's unit
  bool gyro_x_reversed = false;         ///< of the boom's unit, its accelerometer not
  Vec3 antenna_place_m = Vec3::Zero();  ///< of the left antenna
  double reflected_m = 0;               ///< pulls the left antenna towards a boom that is raised
  double boom_zero_rad = 0;
  double poses_late_s = 0;
};

struct Made {
  Wrong wrong;
  std::uint64_t seed = 1;
  double duration_s = 40;
  double lost = 0;      ///< of the rows of each sensor
  double jitter_s = 0;  ///< stamps differ from their times by up to this
  TimeNs epoch_ns = 0;
  Vec3 place_m = Vec3::Zero();                            ///< of all
  double noise = 1;                                       ///< times the usual
  double base_moves = 1, slew_moves = 1, boom_moves = 1;  ///< times the usual
  /// Rate of the swing, reversed within 5 ms every 0.9 s, as at a stop.
  double blows_radps = 0;
  /// Share by which all units feel the swing accelerate more than its rates do.
  double swing_accelerates_more = 0;
  double upper_unit_x_m = -0.3;  ///< of the upper structure's unit from the swing's axis
  bool has_poses = true;
};

/// An alternating displacement at unit rate, reversed within `within_s` each half period.
inline double ToAndFro(double t, double half_s, double within_s) {
  const double in = std::fmod(t, 2 * half_s), from_turn = std::abs(in - half_s);
  const double r = within_s / 2, near_top = std::max(0.0, r - from_turn),
               near_bottom = std::max(0.0, r - (half_s - from_turn));
  return half_s - from_turn - near_top * near_top / (2 * r) + near_bottom * near_bottom / (2 * r);
}

inline Joint Hinge(const std::string& name, int parent, const Pose& X_PJ, const Vec3& axis_J) {
  Joint joint;
  joint.name = name;
  joint.type = JointType::kRevolute;
  joint.parent = parent;
  joint.child = parent + 1;
  joint.X_PJ = X_PJ;
  joint.axis_J = axis_J;
  joint.lower_rad = -3;
  joint.upper_rad = 3;
  joint.max_rate_positive_radps = joint.max_rate_negative_radps = 1;
  return joint;
}

inline MachineModel TurningMachine() {
  MachineModel model;
  model.kind = "made";
  model.links.resize(3);
  for (int k = 0; k < 3; ++k) {
    model.links[k].name = k == 0 ? "undercarriage" : k == 1 ? "upper" : "boom";
    model.links[k].mass_kg = 500;
    model.links[k].inertia_B_kgm2 = 300 * Mat3::Identity();
  }
  model.links[2].com_B_m = {1.5, 0, 0};
  model.joints = {Hinge("swing", 0, MakePose({0.1, 0, 0.7}), Vec3::UnitZ()),
                  Hinge("boom", 1, MakePose({0.8, 0.1, 0.4}, 0, -0.1, 0.05), -Vec3::UnitY())};
  model.levers = {{"swing", 0, -1}, {"boom", 1, -1}};
  return model;
}

inline SensorDescription Described(const std::string& name, const std::string& link,
                                   const Pose& X_BS, double rate_hz, const SensorModel& kind) {
  SensorDescription sensor;
  sensor.name = name;
  sensor.link = link;
  sensor.X_BS = X_BS;
  sensor.clock.rate_hz = rate_hz;
  sensor.model = kind;
  return sensor;
}

class MadeRecording {
 public:
  explicit MadeRecording(const Made& how) : how_(how), model(TurningMachine()) {
    const ImuModel unit = {.gyro_sample_noise_radps = 0.002, .accel_sample_noise_mps2 = 0.03};
    const GnssModel receiver = {.white_horizontal_m = 0.008, .white_vertical_m = 0.012};
    const EncoderModel encoders = {.joints = {"swing", "boom"}, .noise_rad = 0.0005};
    input.machine = "m";
    input.sensors = {
        Described("imu_upper", "upper", MakePose({how.upper_unit_x_m, 0.2, 0.5}, 0.1, 0.2, 1.5), 50,
                  unit),
        Described("imu_boom", "boom", MakePose({1.2, 0.1, 0.2}, 0.2, -0.3, 0.4), 50, unit),
        Described("left", "upper", MakePose({-0.9, 0.5, 1.4}), 5, receiver),
        Described("right", "upper", MakePose({-0.9, -0.5, 1.4}), 5, receiver),
        Described("encoders", "", Pose::Identity(), 50, encoders)};
    measured.recording = "made";
    measured.start_ns = how.epoch_ns;
    measured.imus.resize(5);
    measured.gnss.resize(5);
    for (int s = 0; s < 2; ++s) AddUnit(s);
    for (int s = 2; s < 4; ++s) AddReceiver(s);
    AddEncoders();
    if (how.has_poses) AddPoses();
  }
  /// The input, with this recording's model.
  const DiagnosisInput& Input() {
    input.model = &model;
    return input;
  }
  Pose Base(double t) const {
    const double by = how_.base_moves;
    const Vec3 p(by * (3 * std::sin(0.31 * t) + 0.4 * std::sin(1.1 * t)),
                 by * (0.15 * t + std::sin(0.5 * t)), 0.1 * by * std::sin(0.4 * t));
    return MakePose(how_.place_m + p, 0.03 + 0.03 * by * std::sin(0.9 * t),
                    -0.02 + 0.03 * by * std::sin(0.7 * t + 1), 0.5 + 0.8 * by * std::sin(0.47 * t));
  }
  std::vector<double> Joints(double t) const {
    return {0.2 + how_.slew_moves * (0.9 * std::sin(0.43 * t) + 0.2 * std::sin(1.7 * t)) +
                how_.blows_radps * ToAndFro(t, 0.9, 0.005),
            0.3 + how_.boom_moves * (0.35 * std::sin(0.6 * t + 1) + 0.1 * std::sin(2.1 * t))};
  }
  Pose Frame(int link, const Pose& X_LS, double t) const {
    return ForwardKinematics(model, Base(t), Joints(t))[link] * X_LS;
  }

 private:
  Stream Draw(const std::string& name) const { return {how_.seed, name}; }
  /// Whether a row is kept.
  bool IsKept(const std::string& name, int k) const {
    return Draw(name + "/lost").Uniform(k) >= how_.lost;
  }
  /// The stamp of a measurement at time `t`.
  TimeNs Stamp(const std::string& name, int k, double t) const {
    const double by_s = how_.jitter_s * (2 * Draw(name + "/jitter").Uniform(k) - 1);
    return how_.epoch_ns + FromSeconds(t + by_s);
  }
  int Link(int sensor) const { return model.LinkIndex(input.sensors[sensor].link); }

  void AddUnit(int s) {
    const SensorDescription& unit = input.sensors[s];
    const Stream noise = Draw(unit.name);
    const bool is_wrong = unit.name == "imu_boom";
    Pose X_LS = unit.X_BS;
    if (is_wrong) {
      X_LS.translation() += how_.wrong.place_m;
      const Vec3& turn = how_.wrong.mount_rad;
      X_LS.linear() = X_LS.linear() * RotationFromRpy(turn[0], turn[1], turn[2]);
    }
    std::pair<Vec3, Vec3> filtered = MeanOver(Link(s), X_LS, 0, 0.02);
    const double new_share = !is_wrong || how_.wrong.unit_low_pass_s == 0
                                 ? 1
                                 : 1 - std::exp(-0.02 / how_.wrong.unit_low_pass_s);
    for (int k = 1; k <= how_.duration_s * 50; ++k) {
      const auto now = MeanOver(Link(s), X_LS, 0.02 * k - 0.02, 0.02);
      filtered.first += new_share * (now.first - filtered.first);
      filtered.second += new_share * (now.second - filtered.second);
      if (!IsKept(unit.name, k)) continue;
      ImuSample sample;
      sample.t_ns = Stamp(unit.name, k, 0.02 * k + (is_wrong ? how_.wrong.unit_late_s : 0));
      sample.t_available_ns = sample.t_ns;
      sample.w_WS_S_radps = filtered.first + 0.002 * how_.noise * noise.Gaussian3(k, 0);
      sample.f_S_mps2 = filtered.second + 0.03 * how_.noise * noise.Gaussian3(k, 1);
      if (is_wrong) {
        if (how_.wrong.gyro_x_reversed) sample.w_WS_S_radps.x() *= -1;
        sample.w_WS_S_radps += how_.wrong.gyro_bias_radps;
        sample.f_S_mps2 = sample.f_S_mps2.cwiseProduct(how_.wrong.accel_scale);
        sample.f_S_mps2 += how_.wrong.accel_bias_mps2;
        const Vec3 limit_radps = Vec3::Constant(how_.wrong.gyro_limit_radps);
        sample.w_WS_S_radps = sample.w_WS_S_radps.cwiseMin(limit_radps).cwiseMax(-limit_radps);
      }
      measured.imus[s].push_back(sample);
    }
  }
  /// Mean rates and forces over an interval, by its middle unless blows fall within.
  std::pair<Vec3, Vec3> MeanOver(int link, const Pose& X_LS, double from_s, double over_s) const {
    const int parts = how_.blows_radps > 0 ? 20 : 1;
    const double h = how_.blows_radps > 0 ? over_s / parts / 2 : 1e-3;
    std::pair<Vec3, Vec3> mean = {Vec3::Zero(), Vec3::Zero()};
    for (int i = 0; i < parts; ++i) {
      const double t = from_s + over_s * (i + 0.5) / parts;
      const Pose before = Frame(link, X_LS, t - h), now = Frame(link, X_LS, t),
                 after = Frame(link, X_LS, t + h);
      const Eigen::AngleAxisd turned(before.linear().transpose() * after.linear());
      const Vec3 a_W =
          (before.translation() - 2 * now.translation() + after.translation()) / (h * h);
      mean.first += turned.axis() * turned.angle() / (2 * h) / parts;
      mean.second += now.linear().transpose() *
                     (a_W + MoreOfSwing(link, X_LS, t) + Vec3(0, 0, kStandardGravity_mps2)) / parts;
    }
    return mean;
  }
  /// The acceleration in W that the swing's rates do not have.
  Vec3 MoreOfSwing(int link, const Pose& X_LS, double t) const {
    constexpr double kStep_s = 1e-3, kStep_rad = 1e-4;
    const auto at = [&](double more_rad) -> Vec3 {
      std::vector<double> q = Joints(t);
      q[0] += more_rad;
      return (ForwardKinematics(model, Base(t), q)[link] * X_LS).translation();
    };
    const double qdd =
        (Joints(t - kStep_s)[0] - 2 * Joints(t)[0] + Joints(t + kStep_s)[0]) / (kStep_s * kStep_s);
    return how_.swing_accelerates_more * qdd * (at(kStep_rad) - at(-kStep_rad)) / (2 * kStep_rad);
  }
  Vec3 Reflected(double t) const {
    const Vec3 boom_W = Frame(2, Pose::Identity(), t).linear().col(0);
    const Vec3 level_W = Vec3(boom_W.x(), boom_W.y(), 0).normalized();
    return how_.wrong.reflected_m * std::max(0.0, boom_W.z()) * level_W;
  }
  void AddReceiver(int s) {
    const SensorDescription& receiver = input.sensors[s];
    const Stream noise = Draw(receiver.name);
    Pose X_LS = receiver.X_BS;
    if (receiver.name == "left") X_LS.translation() += how_.wrong.antenna_place_m;
    for (int k = 0; k <= how_.duration_s * 5; ++k) {
      if (!IsKept(receiver.name, k)) continue;
      GnssSample sample;
      sample.t_ns = sample.t_available_ns = Stamp(receiver.name, k, 0.2 * k);
      sample.enu_m = Frame(Link(s), X_LS, 0.2 * k).translation() +
                     how_.noise * noise.Gaussian3(k).cwiseProduct(Vec3(0.008, 0.008, 0.012));
      if (receiver.name == "left") sample.enu_m += Reflected(0.2 * k);
      sample.fix = GnssFix::kRtkFixed;
      sample.variance_enu_m2 = Vec3(0.008, 0.008, 0.012).cwiseAbs2();
      measured.gnss[s].push_back(sample);
    }
  }
  void AddEncoders() {
    NamedEncoders named{.channel = "m/encoders"};
    named.recording.axes = {{"swing"}, {"boom"}};
    const Stream noise = Draw("encoders");
    for (int k = 0; k <= how_.duration_s * 50; ++k) {
      if (!IsKept("encoders", k)) continue;
      EncoderSample sample;
      sample.t_ns = sample.t_available_ns = Stamp("encoders", k, 0.02 * k);
      sample.q_rad = Joints(0.02 * k);
      for (int j = 0; j < 2; ++j) sample.q_rad[j] += 0.0005 * how_.noise * noise.Gaussian(k, j);
      sample.q_rad[1] += how_.wrong.boom_zero_rad;
      sample.qd_radps = {0, 0};
      measured.encoders.resize(1);
      named.recording.samples.push_back(sample);
    }
    measured.encoders = {named};
  }
  void AddPoses() {
    const Stream noise = Draw("poses");
    measured.poses_were_measured = true;
    for (int k = 0; k <= how_.duration_s * 10; ++k) {
      if (!IsKept("poses", k)) continue;
      TruthPose pose;
      pose.t_ns = Stamp("poses", k, 0.1 * k + how_.wrong.poses_late_s);
      const Vec3 turn = 0.002 * how_.noise * noise.Gaussian3(k, 1);
      pose.X_WB = Base(0.1 * k) * MakePose(Vec3::Zero(), turn[0], turn[1], turn[2]);
      pose.X_WB.translation() += 0.01 * how_.noise * noise.Gaussian3(k);
      measured.poses.push_back(pose);
    }
  }

  Made how_;

 public:
  MachineModel model;
  DiagnosisInput input;
  Measurements measured;
};

}  // namespace tera
