#include "blind/mujoco/sensors/readings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "blind/mujoco/plant/model.h"
#include "blind/mujoco/sensors/bracket.h"

namespace tera::blind::mujoco {
namespace {

constexpr double kCutoff_radps = 2 * std::numbers::pi * 35;
constexpr double kDamping = 0.7071;  ///< of Butterworth's

std::array<double, 6> RawOf(const Instant& at, std::size_t unit) {
  const Vec3& w = at.gyro_radps[unit];
  const Vec3& a = at.accelerometer_mps2[unit];
  return {w.x(), w.y(), w.z(), a.x(), a.y(), a.z()};
}

/// Share of an effect that grows with warmth.
double ShareAt(double t_s, double warms_s) {
  return warms_s > 0 ? 1 - std::exp(-std::max(0.0, t_s) / warms_s) : 1;
}

/// How far an arm's pin is raised above an antenna: from half a metre below, towards 1.
double Raised(const Vec3& way_m) {
  const double above_m = std::max(0.0, way_m.z() + 0.5);
  return above_m / (above_m + 0.6);
}

/// A truck that passes reflects for some 4 s each time.
Vec3 Passing_m(const ReceiverForm::Truck& truck, double t_s) {
  if (truck.pull_m == 0) return Vec3::Zero();
  constexpr double kNear_s = 2;
  const double since_s = std::remainder(t_s - truck.first_s, truck.every_s);
  const double pull_m = truck.pull_m * std::exp(-std::pow(since_s / kNear_s, 2));
  return pull_m * Vec3(std::cos(truck.towards_rad), std::sin(truck.towards_rad), 0);
}

std::vector<std::array<double, 6>> SumsOf(const Course& course, std::size_t unit,
                                          const BracketForm& form) {
  std::vector<std::array<double, 6>> sums(course.instants.size() + 1);
  Bracket bracket(form, course.instants.front().accelerometer_mps2[unit]);
  std::array<double, 6> value = bracket.Felt(RawOf(course.instants.front(), unit), 0), slope{};
  for (std::size_t k = 0; k < course.instants.size(); ++k) {
    const std::array<double, 6> raw = bracket.Felt(RawOf(course.instants[k], unit), kStep_s);
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
  for (std::size_t u = 0; u < kUnits; ++u) sums_[u] = SumsOf(course, u, form.units[u].bracket);
}

std::array<double, 6> Readings::Unit(std::size_t unit, double t_s) const {
  const auto steps = static_cast<std::ptrdiff_t>(std::llround(kUnitPeriod_s / kStep_s));
  const auto last = static_cast<std::ptrdiff_t>(course_.instants.size());
  const auto to =
      std::clamp<std::ptrdiff_t>(std::llround((t_s - course_.from_s) / kStep_s) + 1, steps, last);
  std::array<double, 6> mean{};
  const UnitForm& form = form_.units[unit];
  const double there = t_s < form.knocked_s ? 0 : ShareAt(t_s, form.warms_s);
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
  const double angle_rad = course_.At(t_s).angle_rad[axis],
               wound_rad = angle_rad - form.wound_from_rad;
  return ShareAt(t_s, form.warms_s) * form.zero_rad + form.angle_factor * angle_rad +
         form.wound_1prad * wound_rad * wound_rad / 2 +
         form.ring_rad * std::cos(angle_rad - form.ring_at_rad);
}

double Readings::Rate_radps(std::size_t axis, double t_s) const {
  const EncoderForm& form = form_.encoders[axis];
  const Instant& at = course_.At(t_s);
  const double angle_rad = at.angle_rad[axis];
  return at.rate_radps[axis] *
         (form.rate_factor + form.wound_1prad * (angle_rad - form.wound_from_rad) -
          form.ring_rad * std::sin(angle_rad - form.ring_at_rad));
}

Vec3 Readings::ToArm_m(std::size_t receiver, const Instant& at) const {
  const Eigen::AngleAxisd slew(at.angle_rad[kSlew], Vec3::UnitZ());
  const Eigen::AngleAxisd boom(at.angle_rad[kBoom], numbers_.joints[kBoom].axis);
  const Vec3 pin_m = numbers_.joints[kSlew].pin_m +
                     slew * (numbers_.joints[kBoom].pin_m + boom * numbers_.joints[kArm].pin_m);
  return pin_m - numbers_.antennas[receiver].xyz_m;
}

/// The nearer and higher the arm's pin, the more it pulls the place towards itself.
Vec3 Readings::Reflected_m(std::size_t receiver, const Instant& at) const {
  const ReceiverForm& form = form_.receivers[receiver];
  if (form.reflected_m == 0) return Vec3::Zero();
  const Vec3 way_m = ToArm_m(receiver, at);
  double pull_m = form.reflected_m * Raised(way_m);
  if (form.fringe_m > 0) {
    pull_m *= std::cos(2 * std::numbers::pi * way_m.norm() / form.fringe_m);
  }
  return at.q_WB * (pull_m * way_m.normalized());
}

/// Satellites behind a raised arm are hidden: those of the other side push the place away from it,
/// and none above it hold the height.
Vec3 Readings::Shaded_m(std::size_t receiver, const Instant& at) const {
  const double shaded_m = form_.receivers[receiver].shaded_m;
  if (shaded_m == 0) return Vec3::Zero();
  const Vec3 way_m = ToArm_m(receiver, at);
  const Vec3 away = -Vec3(way_m.x(), way_m.y(), 0).normalized() - 0.5 * Vec3::UnitZ();
  return at.q_WB * (shaded_m * Raised(way_m) * away);
}

Vec3 Readings::Receiver_m(std::size_t receiver, double t_s) const {
  const Instant& at = course_.At(t_s);
  const ReceiverForm& form = form_.receivers[receiver];
  return at.antenna_m[receiver] + form.datum_m + Reflected_m(receiver, at) +
         Shaded_m(receiver, at) + Passing_m(form.truck, t_s);
}

}  // namespace tera::blind::mujoco
