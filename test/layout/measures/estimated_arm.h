#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "core/units.h"
#include "dataset/format/site_frame.h"
#include "physics/description/machine.h"
#include "sensors/sensor.h"

// An arm with a random motion, its sensors, and a filter that estimates the motion from their
// measurements. Its geometry, derivatives and time steps are independent of the code under test.

namespace tera {

/// Statistical law of an arm's motion, which the estimate also assumes.
struct ArmLaw {
  double response_s = 0.3;
  Eigen::VectorXd rate_sigma;  ///< stationary, of each coordinate
};

/// A slewing upper structure with boom and arm.
struct Arm {
  bool fixed_base = true;

  /// x, y, z, roll, pitch, yaw of the root where it is free, then the three angles.
  Eigen::Index coordinates() const { return fixed_base ? 3 : 9; }
  Eigen::VectorXd Start() const {
    Eigen::VectorXd c(coordinates());
    if (!fixed_base) c.head<6>() << 3, -2, 1, 0.03, -0.05, 0.9;
    c.tail<3>() << 0.7, 0.3, -0.8;
    return c;
  }
  Pose RootAt(const Eigen::VectorXd& c) const {
    return fixed_base ? MakePose({4, -3, 0.5}, 0, 0, 0.6)
                      : MakePose(Vec3(c.head<3>()), c[3], c[4], c[5]);
  }
  /// Links 1 (upper structure), 2 (boom) and 3 (arm): turned about z, and about -y twice.
  Pose LinkAt(int link, const Eigen::VectorXd& c) const {
    const Vec3 q = c.tail<3>();
    Pose X = RootAt(c) * MakePose({0, 0, 0.56}, 0, 0, q[0]);
    if (link >= 2) X = X * MakePose({0.8, 0, 0.3}, 0, -q[1], 0);
    if (link >= 3) X = X * MakePose({2.5, 0, 0}, 0, -q[2], 0);
    return X;
  }

  MachineModel Model() const {
    MachineModel model;
    model.kind = "arm";
    model.fixed_base = fixed_base;
    for (const char* name : {"root", "upper", "boom", "arm"}) {
      model.links.emplace_back().name = name;
    }
    const auto add = [&](const char* name, JointType type, const Vec3& p_m, const Vec3& axis) {
      Joint joint;
      joint.name = name;
      joint.type = type;
      joint.parent = static_cast<int>(model.joints.size());
      joint.child = joint.parent + 1;
      joint.X_PJ = MakePose(p_m);
      joint.axis_J = axis;
      joint.lower_rad = -10 * kDeg;
      joint.upper_rad = 10 * kDeg;
      joint.max_rate_positive_radps = 20 * kDeg;
      joint.max_rate_negative_radps = 15 * kDeg;
      model.joints.push_back(joint);
    };
    add("slew", JointType::kContinuous, {0, 0, 0.56}, Vec3::UnitZ());
    add("boom", JointType::kRevolute, {0.8, 0, 0.3}, -Vec3::UnitY());
    add("arm", JointType::kRevolute, {2.5, 0, 0}, -Vec3::UnitY());
    return model;
  }
};

/// Coordinates, their rates and accelerations at one time.
struct ArmMotion {
  Eigen::VectorXd c, v, a;
};

/// Steps of the simulation, and their number between two samples of inertial units at 50 Hz.
inline constexpr double kCourseStep_s = 0.002;
inline constexpr int kStepsASample = 10;
inline constexpr double kSample_s = kCourseStep_s * kStepsASample;

/// A motion drawn by the law, in small steps: a' = -2 a / tau - v / tau^2 + noise.
inline std::vector<ArmMotion> DrawCourse(const Arm& arm, const ArmLaw& law, int steps,
                                         std::uint64_t seed) {
  const Stream stream(seed, "course");
  const Eigen::Index n = arm.coordinates();
  const double h = kCourseStep_s, w = 1 / law.response_s;
  std::uint64_t next = 0;
  const auto draw = [&] {
    Eigen::VectorXd normal(n);
    for (double& x : normal) x = stream.Gaussian(next++);
    return Eigen::VectorXd(normal.cwiseProduct(law.rate_sigma));
  };
  ArmMotion now{arm.Start(), draw(), w * draw()};
  std::vector<ArmMotion> course = {now};
  for (int k = 0; k < steps; ++k) {
    now.a += h * (-2 * w * now.a - w * w * now.v) + std::sqrt(4 * w * w * w * h) * draw();
    now.v += h * now.a;
    now.c += h * now.v;
    course.push_back(now);
  }
  return course;
}

/// Measurements of an arm's sensors over a course, at each time of the inertial units; empty where
/// a slower sensor has none. Inertial units and antennas are in the order of the rig.
struct ArmSamples {
  struct Moment {
    std::vector<ImuSample> imus;
    std::vector<EncoderSample> encoders;
    std::vector<GnssSample> antennas;
  };
  std::vector<Moment> moments;
};

inline int LinkOf(const SensorDescription& sensor) {
  return sensor.link == "upper" ? 1 : sensor.link == "boom" ? 2 : 3;
}

/// Biases of the units are drawn with the model's deviation.
inline void MeasureImu(const Arm& arm, const SensorDescription& sensor,
                       const std::vector<ArmMotion>& course, std::uint64_t seed,
                       ArmSamples* samples) {
  const Stream biases(seed, sensor.name + "/biases");
  ImuModel model = std::get<ImuModel>(sensor.model);
  model.gyro_bias_radps = model.gyro_bias_radps.cwiseProduct(biases.Gaussian3(0));
  model.accel_bias_mps2 = model.accel_bias_mps2.cwiseProduct(biases.Gaussian3(1));
  Imu imu(model, sensor.X_BS, sensor.clock, 0, seed, sensor.name);
  std::vector<ImuSample> measured;
  const auto body = [&](std::size_t k) {
    BodyState state;
    state.X_WB = arm.LinkAt(LinkOf(sensor), course[k].c);
    return state;
  };
  BodyState begin = body(0);
  for (std::size_t k = 0; k + 1 < course.size(); ++k) {
    const BodyState end = body(k + 1);
    imu.Advance(FromSeconds(k * kCourseStep_s), begin, FromSeconds((k + 1) * kCourseStep_s), end,
                {0, 0, -kStandardGravity_mps2}, &measured);
    begin = end;
  }
  imu.Finish(&measured);
  for (std::size_t m = 1; m < samples->moments.size(); ++m) {
    samples->moments[m].imus.push_back(measured.at(m - 1));
  }
}

/// `rig` has inertial units at 50 Hz, encoders of the slew joint and antennas at 10 Hz.
inline ArmSamples SamplesOf(const Arm& arm, const std::vector<SensorDescription>& rig,
                            const std::vector<ArmMotion>& course, std::uint64_t seed) {
  constexpr std::size_t kSamplesASlowOne = 5;
  const SiteFrame site(46.8, -71.3, 90);
  ArmSamples samples;
  samples.moments.resize(course.size() / kStepsASample + 1);
  for (const SensorDescription& sensor : rig) {
    if (std::holds_alternative<ImuModel>(sensor.model)) {
      MeasureImu(arm, sensor, course, seed, &samples);
      continue;
    }
    const auto* encoders = std::get_if<EncoderModel>(&sensor.model);
    const auto* receiver = std::get_if<GnssModel>(&sensor.model);
    const Encoder encoder(encoders ? *encoders : EncoderModel{}, sensor.clock, 0, seed,
                          sensor.name);
    Gnss gnss(receiver ? *receiver : GnssModel{}, sensor.clock, 0, seed, sensor.name);
    for (std::size_t m = 0; m < samples.moments.size(); m += kSamplesASlowOne) {
      const ArmMotion& now = course[m * kStepsASample];
      const auto k = static_cast<std::int64_t>(m / kSamplesASlowOne);
      if (encoders) {
        const Eigen::Index slew = arm.coordinates() - 3;
        samples.moments[m].encoders.push_back(encoder.Measure(k, {now.c[slew]}, {now.v[slew]}));
      } else {
        const Vec3 p_WS_m = arm.LinkAt(LinkOf(sensor), now.c) * sensor.X_BS.translation();
        samples.moments[m].antennas.push_back(gnss.Measure(k, p_WS_m, site));
      }
    }
  }
  return samples;
}

}  // namespace tera
