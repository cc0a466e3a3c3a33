#include "diagnose/motion/linearise_unit.h"

#include <ceres/jet.h>

#include <algorithm>
#include <type_traits>

#include "diagnose/motion/link_motion.h"

namespace tera {
namespace {

// Layout of the derivatives by the motion: angles with rates and accelerations (9), acceleration of
// the base (3), position, rate and acceleration of each joint (3 each).
constexpr int kImuJoints = 12;

template <typename T>
T Variable(double value, int derivative) {
  if constexpr (std::is_same_v<T, double>) {
    return value;
  } else {
    return T(value, derivative);
  }
}

/// Measurement of an ideal unit in the frame of its link. A Jet scalar carries derivatives by the
/// motion.
template <typename T>
Inertial<T> InLink(const UnitChannel& unit, const MotionAt& at, const Numbers& numbers) {
  std::array<Vector3<T>, 3> rpy;
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) {
      rpy[static_cast<std::size_t>(k)][i] = Variable<T>(numbers(kRoll + i, k), 3 * k + i);
    }
  }
  rpy[2][kYaw - kRoll] *= T(at.Share(kYaw));
  Vector3<T> a_W;
  for (int i = 0; i < 3; ++i) a_W[i] = Variable<T>(numbers(i, 2), 9 + i);
  std::array<std::array<T, kMostJointsOfChain>, 3> q;
  for (std::size_t s = 0; s < unit.chain.steps.size(); ++s) {
    for (std::size_t k = 0; k < 3; ++k) {
      q[k][s] = Variable<T>(numbers(kBaseNumbers + unit.chain.steps[s].place, static_cast<int>(k)),
                            kImuJoints + static_cast<int>(3 * s + k));
    }
    q[2][s] *= T(at.Share(kBaseNumbers + unit.chain.steps[s].place));
  }
  return InertialOfLink<T>(unit.chain, InertialOfBase<T>(rpy[0], rpy[1], rpy[2], a_W), q[0].data(),
                           q[1].data(), q[2].data());
}

/// Measurement of an ideal unit for the motion with insignificant rates set to zero. `by_own` holds
/// the derivatives by mount angles, then by place.
struct AtRest {
  Eigen::Matrix<double, 6, 1> value = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 6> by_own = Eigen::Matrix<double, 6, 6>::Zero();
};

AtRest AtRestOf(const UnitChannel& unit, const MotionAt& at, const Vec3& turn, const Mat3& R_LT,
                const Vec3& r_L) {
  using T = ceres::Jet<double, 3>;
  const Inertial<double> link = InLink<double>(unit, at, at.resting);
  const Mat3 R_SL = unit.X_LS.linear().transpose();
  const Vec3 w_S = R_SL * link.w,
             f_S = R_SL * (link.f + link.alpha.cross(r_L) + link.w.cross(link.w.cross(r_L)));
  const Matrix3<T> R_TS =
      RotationOfRpy<T>(Vector3<T>(T(turn[0], 0), T(turn[1], 1), T(turn[2], 2))).transpose();
  AtRest rest;
  for (int i = 0; i < 3; ++i) {
    const T w = R_TS.row(i).dot(w_S.cast<T>()), f = R_TS.row(i).dot(f_S.cast<T>());
    rest.value[i] = w.a, rest.value[3 + i] = f.a;
    rest.by_own.block<1, 3>(i, 0) = w.v.transpose();
    rest.by_own.block<1, 3>(3 + i, 0) = f.v.transpose();
    const Vec3 along = Vec3::Unit(i);
    rest.by_own.block<3, 1>(3, 3 + i) =
        R_LT.transpose() * (link.alpha.cross(along) + link.w.cross(link.w.cross(along)));
  }
  return rest;
}

/// Adds the acceleration gains of the base and of each joint in the chain.
void AddAccelerationGains(const UnitChannel& unit, const MotionAt& at) {
  const auto add = [&](int number) {
    if (at.GainOf(number) < 0) return;
    const int column = at.AddParameter(at.GainOf(number));
    at.out->by_parameter.col(column) =
        at.out->by_state.col(at.Column(number, 2)) * (at.resting(number, 2) / at.Share(number));
  };
  for (int number = 0; number < kBaseNumbers; ++number) add(number);
  for (const auto& step : unit.chain.steps) add(kBaseNumbers + step.place);
}

/// Applies the clipping of the unit's range. `resting` is the measurement for the motion with
/// insignificant rates set to zero.
void Clip(const UnitChannel& unit, const MotionAt& at, const Eigen::Matrix<double, 6, 1>& resting) {
  if (unit.clipped < 0) return;
  LinearisedObservation& out = *at.out;
  const std::array<int, 2> columns = {at.AddParameter(unit.clipped),
                                      at.AddParameter(unit.clipped + 1)};
  for (int row = 0; row < 6; ++row) {
    const auto triad = static_cast<std::size_t>(row / 3);
    const auto beyond = [&](double measured) {
      return std::copysign(std::max(0.0, std::abs(measured) - unit.limit[triad]), measured);
    };
    const double share = at.parameters[unit.clipped + row / 3];
    const double excess = beyond(at.observation.value[row] - out.residual[row]);
    out.by_parameter(row, columns[triad]) = -beyond(resting[row]);
    if (excess == 0) continue;
    out.residual[row] += share * excess;
    out.by_state.row(row) *= 1 - share;
    out.by_parameter.row(row).head(columns[0]) *= 1 - share;
  }
}

/// `kJoints` is the longest chain for which derivatives are carried.
template <int kJoints>
void LineariseImu(const UnitChannel& unit, const MotionAt& at) {
  at.Begin(6, unit.noise);
  LinearisedObservation& out = *at.out;
  const Vec3 turn = at.Three(unit.mount), r_L = unit.X_LS.translation() + at.Three(unit.place);
  const Mat3 R_LT = unit.X_LS.linear() * RotationOfRpy<double>(turn);
  using T = ceres::Jet<double, kImuJoints + 3 * kJoints>;
  const Inertial<T> there = InertialBeside<T, double>(InLink<T>(unit, at, at.numbers), R_LT, r_L);
  AtRest rest = AtRestOf(unit, at, turn, R_LT, r_L);
  Eigen::Matrix<double, 6, 1> ideal, by_delay, by_time_constant;
  for (int row = 0; row < 6; ++row) ideal[row] = row < 3 ? there.w[row].a : there.f[row - 3].a;
  if (at.filtered) {
    const auto mean = [&](const FilteredUnit::Rows& rows) {
      return at.filtered->MeanOver(rows, at.from_s, at.to_s);
    };
    ideal = mean(at.filtered->value);
    rest.value = mean(at.filtered->resting);
    by_delay = mean(at.filtered->by_delay);
    by_time_constant = mean(at.filtered->by_time_constant);
  }
  const int mount = unit.mount < 0 ? -1 : out.parameters;
  for (int i = 0; mount >= 0 && i < 3; ++i) at.AddParameter(unit.mount + i);
  const int place = unit.place < 0 ? -1 : out.parameters;
  for (int i = 0; place >= 0 && i < 3; ++i) at.AddParameter(unit.place + i);
  for (int row = 0; row < 6; ++row) {
    const T& moved = row < 3 ? there.w[row] : there.f[row - 3];
    const double scale = unit.scale < 0 ? 1 : at.parameters[unit.scale + row];
    const double factor = unit.signs[row] * scale;
    const double bias = unit.bias < 0 ? 0 : at.parameters[unit.bias + row];
    const auto v = factor * moved.v;
    out.residual[row] = at.observation.value[row] - factor * ideal[row] - bias;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) out.by_state(row, at.Column(kRoll + i, k)) = v[3 * k + i];
      out.by_state(row, at.Column(i, 2)) = v[9 + i];
      if (mount >= 0) out.by_parameter(row, mount + i) = factor * rest.by_own(row, i);
      if (place >= 0) out.by_parameter(row, place + i) = factor * rest.by_own(row, 3 + i);
    }
    for (std::size_t s = 0; s < unit.chain.steps.size(); ++s) {
      for (int k = 0; k < 3; ++k) {
        out.by_state(row, at.Column(kBaseNumbers + unit.chain.steps[s].place, k)) =
            v[kImuJoints + 3 * static_cast<int>(s) + k];
      }
    }
    if (unit.scale >= 0) {
      out.by_parameter(row, at.AddParameter(unit.scale + row)) = unit.signs[row] * rest.value[row];
    }
    if (unit.bias >= 0) out.by_parameter(row, at.AddParameter(unit.bias + row)) = 1;
  }
  if (!at.filtered) AddAccelerationGains(unit, at);
  const int late = unit.late < 0 ? -1 : out.parameters;
  at.AddDelay(unit.late);
  Eigen::Matrix<double, 6, 1> resting;
  const int low_pass = at.filtered ? at.AddParameter(unit.low_pass) : -1;
  for (int row = 0; row < 6; ++row) {
    const double factor = unit.signs[row] * (unit.scale < 0 ? 1 : at.parameters[unit.scale + row]);
    if (at.filtered) out.by_parameter(row, low_pass) = factor * by_time_constant[row];
    if (at.filtered && late >= 0) out.by_parameter(row, late) = factor * by_delay[row];
    resting[row] = factor * rest.value[row] + (unit.bias < 0 ? 0 : at.parameters[unit.bias + row]);
  }
  Clip(unit, at, resting);
  if (at.filtered) out.by_state.setZero();
}

}  // namespace

Eigen::Matrix<double, 6, 1> IdealOf(const UnitChannel& unit, const MotionAt& at,
                                    const Numbers& numbers) {
  const Mat3 R_LT = unit.X_LS.linear() * RotationOfRpy<double>(at.Three(unit.mount));
  const Inertial<double> there = InertialBeside<double, double>(
      InLink<double>(unit, at, numbers), R_LT, unit.X_LS.translation() + at.Three(unit.place));
  Eigen::Matrix<double, 6, 1> ideal;
  ideal << there.w, there.f;
  return ideal;
}

void LineariseUnit(const UnitChannel& unit, const MotionAt& at) {
  const std::size_t joints = unit.chain.steps.size();
  if (joints == 0) return LineariseImu<0>(unit, at);
  return joints <= 4 ? LineariseImu<4>(unit, at) : LineariseImu<kMostJointsOfChain>(unit, at);
}

}  // namespace tera
