#include "blind/mujoco/sensors/readings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "blind/mujoco/plant/model.h"

namespace tera::blind::mujoco {
namespace {

constexpr double kCutoff_radps = 2 * std::numbers::pi * 35;
constexpr double kDamping = 0.7071;  ///< of Butterworth's

std::array<double, 6> RawOf(const Instant& at, std::size_t unit) {
  const Vec3& w = at.gyro_radps[unit];
  const Vec3& a = at.accelerometer_mps2[unit];
  return {w.x(), w.y(), w.z(), a.x(), a.y(), a.z()};
}

/// Of what comes with warmth.
double ShareAt(double t_s, double warms_s) {
  return warms_s > 0 ? 1 - std::exp(-std::max(0.0, t_s) / warms_s) : 1;
}

std::vector<std::array<double, 6>> SumsOf(const Course& course, std::size_t unit) {
  std::vector<std::array<double, 6>> sums(course.instants.size() + 1);
  std::array<double, 6> value = RawOf(course.instants.front(), unit), slope{};
  for (std::size_t k = 0; k < course.instants.size(); ++k) {
    const std::array<double, 6> raw = RawOf(course.instants[k], unit);
    for (std::size_t i = 0; i < 6; ++i) {
      slope[i] += kStep_s * (kCutoff_radps * kCutoff_radps * (raw[i] - value[i]) -
                             2 * kDamping * kCutoff_radps * slope[i]);
      value[i] += kStep_s * slope[i];
      sums[k + 1][i] = sums[k][i] + value[i];
    }
  }
  return sums;
}

}  // namespace

Readings::Readings(const MachineNumbers& numbers, const Course& course, const SensorsForm& form)
    : numbers_(numbers), course_(course), form_(form) {
  for (std::size_t u = 0; u < kUnits; ++u) sums_[u] = SumsOf(course, u);
}

std::array<double, 6> Readings::Unit(std::size_t unit, double t_s) const {
  const auto steps = static_cast<std::ptrdiff_t>(std::llround(kUnitPeriod_s / kStep_s));
  const auto last = static_cast<std::ptrdiff_t>(course_.instants.size());
  const auto to =
      std::clamp<std::ptrdiff_t>(std::llround((t_s - course_.from_s) / kStep_s) + 1, steps, last);
  std::array<double, 6> mean{};
  const UnitForm& form = form_.units[unit];
  const double there = ShareAt(t_s, form.warms_s);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& sums = sums_[unit];
    mean[i] =
        (sums[static_cast<std::size_t>(to)][i] - sums[static_cast<std::size_t>(to - steps)][i]) /
        static_cast<double>(steps);
    const auto k = static_cast<Eigen::Index>(i);
    mean[i] += there * (i < 3 ? form.gyro_radps[k] : form.accelerometer_mps2[k - 3]);
  }
  return mean;
}

double Readings::Angle_rad(std::size_t axis, double t_s) const {
  const EncoderForm& form = form_.encoders[axis];
  const double angle_rad = course_.At(t_s).angle_rad[axis];
  return ShareAt(t_s, form.warms_s) * form.zero_rad + form.angle_factor * angle_rad +
         form.eccentric_rad * std::sin(2 * angle_rad);
}

double Readings::Rate_radps(std::size_t axis, double t_s) const {
  const EncoderForm& form = form_.encoders[axis];
  const Instant& at = course_.At(t_s);
  return at.rate_radps[axis] *
         (form.rate_factor + 2 * form.eccentric_rad * std::cos(2 * at.angle_rad[axis]));
}

/// The nearer and higher the arm's pin, the more it pulls the place towards itself.
Vec3 Readings::Reflected_m(std::size_t receiver, const Instant& at) const {
  const ReceiverForm& form = form_.receivers[receiver];
  if (form.reflected_m == 0) return Vec3::Zero();
  const Eigen::AngleAxisd slew(at.angle_rad[kSlew], Vec3::UnitZ());
  const Eigen::AngleAxisd boom(at.angle_rad[kBoom], numbers_.joints[kBoom].axis);
  const Vec3 pin_m = numbers_.joints[kSlew].pin_m +
                     slew * (numbers_.joints[kBoom].pin_m + boom * numbers_.joints[kArm].pin_m);
  const Vec3 way_m = pin_m - numbers_.antennas[receiver].xyz_m;
  const double above_m = std::max(0.0, way_m.z() + 0.5);
  double pull_m = form.reflected_m * above_m / (above_m + 0.6);
  if (form.fringe_m > 0) {
    pull_m *= std::cos(2 * std::numbers::pi * way_m.norm() / form.fringe_m);
  }
  return at.q_WB * (pull_m * way_m.normalized());
}

Vec3 Readings::Receiver_m(std::size_t receiver, double t_s) const {
  const Instant& at = course_.At(t_s);
  return at.antenna_m[receiver] + form_.receivers[receiver].datum_m + Reflected_m(receiver, at);
}

}  // namespace tera::blind::mujoco
