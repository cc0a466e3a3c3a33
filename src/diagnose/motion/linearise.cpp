#include "diagnose/motion/linearise.h"

#include <ceres/jet.h>

#include <algorithm>
#include <type_traits>

#include "diagnose/motion/link_motion.h"

namespace tera {
namespace {

// Travel by running gear only keeps the motion determined where nothing else measures it.
constexpr double kTravelShare = 0.3, kTravel_mps = 0.1, kTravel_radps = 0.1;
// A machine that stands rocks as its arm moves, and turns less.
constexpr double kRocks_mps = 0.03, kRocks_radps = 0.05, kTurns_radps = 0.01;
constexpr double kGround_m = 0.05, kGround_rad = 0.035;

/// The motion at the time of an observation: numbers by derivative, one column each.
using Numbers = Eigen::Matrix<double, Eigen::Dynamic, 4>;

struct At {
  const MotionProblem& problem;
  const Eigen::VectorXd& parameters;
  const Observation& observation;
  const Numbers& numbers;
  const Numbers& resting;  ///< the same, 0 where they are no more than noise
  LinearisedObservation* out;

  int columns() const { return static_cast<int>(numbers.rows()); }
  double Parameter(int place) const { return place < 0 ? 0 : parameters[place]; }
  Vec3 Three(int place) const {
    return place < 0 ? Vec3::Zero() : Vec3(parameters.segment<3>(place));
  }
  int GainOf(int number) const {
    const auto n = static_cast<std::size_t>(number);
    return n < problem.acceleration_gains.size() ? problem.acceleration_gains[n] : kNoParameter;
  }
  /// Inertial units have the acceleration of a number multiplied by this.
  double Share(int number) const { return 1 + Parameter(GainOf(number)); }
  /// The column of a derivative of a number in `by_state`.
  int Column(int number, int derivative) const { return derivative * columns() + number; }
  int AddParameter(int place) const {
    out->parameter[static_cast<std::size_t>(out->parameters)] = place;
    out->by_parameter.col(out->parameters).setZero();
    return out->parameters++;
  }
  /// The derivative by a delay: the motion is that of a time before.
  void AddDelay(int place) const {
    if (place < 0) return;
    const int column = AddParameter(place);
    for (int k = 0; k < 3; ++k) {
      out->by_parameter.col(column) -=
          out->by_state.middleCols(k * columns(), columns()) * resting.col(k + 1);
    }
  }
  void Begin(int rows, int noise) const {
    out->rows = rows;
    out->noise = noise;
    out->parameters = 0;
    out->residual.setZero();
    out->sigma.setOnes();
    out->by_state.setZero(6, 3 * columns());
  }
};

// Derivatives of an inertial unit by the motion: angles with their rates and accelerations (9),
// acceleration (3), joints (3 each).
constexpr int kImuJoints = 12;

template <typename T>
T Variable(double value, int derivative) {
  if constexpr (std::is_same_v<T, double>) {
    return value;
  } else {
    return T(value, derivative);
  }
}

/// Measurement of an ideal unit in the frame of a unit's link for these numbers, with derivatives
/// by the motion if the scalar has any.
template <typename T>
Inertial<T> InLink(const UnitChannel& unit, const At& at, const Numbers& numbers) {
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

/// Measurement of an ideal unit whose motion rests where it is only noise, and its derivatives by
/// the unit's mount and place.
struct AtRest {
  Eigen::Matrix<double, 6, 1> value = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 6> by_own = Eigen::Matrix<double, 6, 6>::Zero();
};

AtRest AtRestOf(const UnitChannel& unit, const At& at, const Vec3& turn, const Mat3& R_LT,
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

/// Adds the gains of the accelerations of the base and of each joint before the unit.
void AddAccelerationGains(const UnitChannel& unit, const At& at) {
  const auto add = [&](int number) {
    if (at.GainOf(number) < 0) return;
    const int column = at.AddParameter(at.GainOf(number));
    at.out->by_parameter.col(column) =
        at.out->by_state.col(at.Column(number, 2)) * (at.resting(number, 2) / at.Share(number));
  };
  for (int number = 0; number < kBaseNumbers; ++number) add(number);
  for (const auto& step : unit.chain.steps) add(kBaseNumbers + step.place);
}

/// With derivatives by the motion of chains of up to so many joints.
template <int kJoints>
void LineariseImu(const UnitChannel& unit, const At& at) {
  at.Begin(6, unit.noise);
  LinearisedObservation& out = *at.out;
  const Vec3 turn = at.Three(unit.mount), r_L = unit.X_LS.translation() + at.Three(unit.place);
  const Mat3 R_LT = unit.X_LS.linear() * RotationOfRpy<double>(turn);
  using T = ceres::Jet<double, kImuJoints + 3 * kJoints>;
  const Inertial<T> there = InertialBeside<T, double>(InLink<T>(unit, at, at.numbers), R_LT, r_L);
  const AtRest rest = AtRestOf(unit, at, turn, R_LT, r_L);
  const int mount = unit.mount < 0 ? -1 : out.parameters;
  for (int i = 0; mount >= 0 && i < 3; ++i) at.AddParameter(unit.mount + i);
  const int place = unit.place < 0 ? -1 : out.parameters;
  for (int i = 0; place >= 0 && i < 3; ++i) at.AddParameter(unit.place + i);
  for (int row = 0; row < 6; ++row) {
    const T& ideal = row < 3 ? there.w[row] : there.f[row - 3];
    const double scale = unit.scale < 0 ? 1 : at.parameters[unit.scale + row];
    const double factor = unit.signs[row] * scale;
    const double bias = unit.bias < 0 ? 0 : at.parameters[unit.bias + row];
    const auto v = factor * ideal.v;
    out.residual[row] = at.observation.value[row] - factor * ideal.a - bias;
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
  AddAccelerationGains(unit, at);
  at.AddDelay(unit.late);
}

void LineariseImu(const UnitChannel& unit, const At& at) {
  const std::size_t joints = unit.chain.steps.size();
  if (joints == 0) return LineariseImu<0>(unit, at);
  return joints <= 4 ? LineariseImu<4>(unit, at) : LineariseImu<kMostJointsOfChain>(unit, at);
}

/// Adds the four numbers of a reflection; returns its error in W.
Vec3 AddReflection(const ReceiverChannel& receiver, const At& at) {
  if (receiver.reflection < 0) return Vec3::Zero();
  const Eigen::Matrix<double, 3, 4> by_number =
      ByReflection(receiver.raised.At(Eigen::VectorXd(at.numbers.col(0))));
  for (int i = 0; i < 4; ++i) {
    const int column = at.AddParameter(receiver.reflection + i);
    at.out->by_parameter.block<3, 1>(0, column) = by_number.col(i);
  }
  return by_number * at.parameters.segment<4>(receiver.reflection);
}

// Derivatives of a receiver: angles (3), joints, place (3), the pair's yaw.
constexpr int kGnssJoints = 3, kGnssPlace = kGnssJoints + kMostJointsOfChain,
              kGnssYaw = kGnssPlace + 3, kGnssDerivatives = kGnssYaw + 1;

void LineariseReceiver(const ReceiverChannel& receiver, const At& at) {
  using T = ceres::Jet<double, kGnssDerivatives>;
  at.Begin(3, receiver.noise);
  LinearisedObservation& out = *at.out;
  const Vec3 shifted = at.Three(receiver.place), datum = at.Three(receiver.datum);
  const T turn(at.Parameter(receiver.pair_yaw), kGnssYaw);
  Vector3<T> rpy, from_middle;
  for (int i = 0; i < 3; ++i) {
    rpy[i] = T(at.numbers(kRoll + i, 0), i);
    from_middle[i] = T(receiver.p_LS_m[i] + shifted[i] - receiver.middle_L_m[i], kGnssPlace + i);
  }
  std::array<T, kMostJointsOfChain> q;
  for (std::size_t s = 0; s < receiver.chain.steps.size(); ++s) {
    q[s] = T(at.numbers(kBaseNumbers + receiver.chain.steps[s].place, 0),
             kGnssJoints + static_cast<int>(s));
  }
  const Vector3<T> p_L =
      RotationAbout<T>(Vec3::UnitZ(), turn) * from_middle + receiver.middle_L_m.cast<T>();
  const Vector3<T> away = RotationOfRpy<T>(rpy) * PointInBase<T>(receiver.chain, p_L, q.data());
  const auto add_three = [&](int place) {
    const int first = place < 0 ? -1 : out.parameters;
    for (int i = 0; first >= 0 && i < 3; ++i) at.AddParameter(place + i);
    return first;
  };
  const int place = add_three(receiver.place), shift = add_three(receiver.datum);
  const int yaw = receiver.pair_yaw < 0 ? -1 : at.AddParameter(receiver.pair_yaw);
  const Vec3 reflected = AddReflection(receiver, at);
  for (int row = 0; row < 3; ++row) {
    out.residual[row] =
        at.observation.value[row] - at.numbers(row, 0) - away[row].a - datum[row] - reflected[row];
    out.by_state(row, at.Column(row, 0)) = 1;
    for (int i = 0; i < 3; ++i) {
      out.by_state(row, at.Column(kRoll + i, 0)) = away[row].v[i];
      if (place >= 0) out.by_parameter(row, place + i) = away[row].v[kGnssPlace + i];
    }
    if (shift >= 0) out.by_parameter(row, shift + row) = 1;
    if (yaw >= 0) out.by_parameter(row, yaw) = away[row].v[kGnssYaw];
    for (std::size_t s = 0; s < receiver.chain.steps.size(); ++s) {
      out.by_state(row, at.Column(kBaseNumbers + receiver.chain.steps[s].place, 0)) =
          away[row].v[kGnssJoints + static_cast<int>(s)];
    }
  }
  at.AddDelay(receiver.late);
}

void LineariseAxis(const AxisChannel& axis, const At& at) {
  at.Begin(1, axis.noise);
  LinearisedObservation& out = *at.out;
  const double q = at.numbers(axis.number, 0);
  const double scale = axis.scale < 0 ? 1 : at.parameters[axis.scale];
  out.residual[0] = at.observation.value[0] - scale * q - at.Parameter(axis.bias);
  out.by_state(0, at.Column(axis.number, 0)) = scale;
  if (axis.bias >= 0) out.by_parameter(0, at.AddParameter(axis.bias)) = 1;
  if (axis.scale >= 0) out.by_parameter(0, at.AddParameter(axis.scale)) = q;
  at.AddDelay(axis.late);
}

void LinearisePose(const MapChannel& poses, const At& at) {
  using T = ceres::Jet<double, 9>;  // place, angles, turn of the map
  at.Begin(6, poses.noise);
  LinearisedObservation& out = *at.out;
  const Vec3 turned = at.Three(poses.turn), shift = at.Three(poses.shift);
  Vector3<T> p, rpy, turn;
  for (int i = 0; i < 3; ++i) {
    p[i] = T(at.numbers(i, 0) - poses.pivot_m[i], i);
    rpy[i] = T(at.numbers(kRoll + i, 0), 3 + i);
    turn[i] = T(turned[i], 6 + i);
  }
  const Matrix3<T> R_ML = RotationOfRpy<T>(turn).transpose();
  const Vec3 read = at.observation.value.tail<3>();
  const Matrix3<T> error =
      RotationOfRpy<double>(read).transpose().cast<T>() * (R_ML * RotationOfRpy<T>(rpy));
  Eigen::Matrix<T, 6, 1> predicted;
  predicted << R_ML * p, (error(2, 1) - error(1, 2)) * 0.5, (error(0, 2) - error(2, 0)) * 0.5,
      (error(1, 0) - error(0, 1)) * 0.5;
  const auto add_three = [&](int place) {
    const int first = place < 0 ? -1 : out.parameters;
    for (int i = 0; first >= 0 && i < 3; ++i) at.AddParameter(place + i);
    return first;
  };
  const int moved = add_three(poses.shift), turns = add_three(poses.turn);
  for (int row = 0; row < 6; ++row) {
    out.residual[row] = -predicted[row].a;
    if (row < 3) out.residual[row] += at.observation.value[row] - poses.pivot_m[row] - shift[row];
    for (int i = 0; i < 6; ++i) out.by_state(row, at.Column(i, 0)) = predicted[row].v[i];
    if (moved >= 0 && row < 3) out.by_parameter(row, moved + row) = 1;
    for (int i = 0; turns >= 0 && i < 3; ++i) {
      out.by_parameter(row, turns + i) = predicted[row].v[6 + i];
    }
  }
  at.AddDelay(poses.late);
}

void LineariseTravel(const At& at) {
  at.Begin(3, kNoParameter);
  LinearisedObservation& out = *at.out;
  const double yaw = at.numbers(kYaw, 0), c = std::cos(yaw), s = std::sin(yaw);
  const double vx = at.numbers(0, 1), vy = at.numbers(1, 1);
  const double forward_mps = at.observation.value[0], turning_radps = at.observation.value[1];
  out.residual << forward_mps - (c * vx + s * vy), -(c * vy - s * vx),
      turning_radps - at.numbers(kYaw, 1), 0, 0, 0;
  const double slip_mps = kTravelShare * std::abs(forward_mps) + kTravel_mps;
  out.sigma << slip_mps, slip_mps, kTravelShare * std::abs(turning_radps) + kTravel_radps, 1, 1, 1;
  out.by_state(0, at.Column(0, 1)) = c;
  out.by_state(0, at.Column(1, 1)) = s;
  out.by_state(0, at.Column(kYaw, 0)) = c * vy - s * vx;
  out.by_state(1, at.Column(0, 1)) = -s;
  out.by_state(1, at.Column(1, 1)) = c;
  out.by_state(1, at.Column(kYaw, 0)) = -c * vx - s * vy;
  out.by_state(2, at.Column(kYaw, 1)) = 1;
}

void LineariseStill(const At& at) {
  at.Begin(6, kNoParameter);
  LinearisedObservation& out = *at.out;
  for (int i = 0; i < 6; ++i) {
    out.residual[i] = -at.numbers(i, 1);
    out.sigma[i] = i < 3 ? kRocks_mps : i == kYaw ? kTurns_radps : kRocks_radps;
    out.by_state(i, at.Column(i, 1)) = 1;
  }
}

void LineariseRest(const At& at) {
  at.Begin(1, kNoParameter);
  const int number = at.observation.channel;
  at.out->residual[0] = -at.numbers(number, 1);
  at.out->sigma[0] = kTurns_radps;
  at.out->by_state(0, at.Column(number, 1)) = 1;
}

void LineariseGround(const At& at) {
  at.Begin(3, kNoParameter);
  LinearisedObservation& out = *at.out;
  for (int i = 0; i < 3; ++i) {
    out.residual[i] = at.observation.value[i] - at.numbers(2 + i, 0);
    out.sigma[i] = i == 0 ? kGround_m : kGround_rad;
    out.by_state(i, at.Column(2 + i, 0)) = 1;
  }
  if (at.problem.ground_height < 0) return;
  const int datum = at.AddParameter(at.problem.ground_height);
  out.residual[0] -= at.Parameter(at.problem.ground_height);
  out.by_parameter(0, datum) = 1;
}

/// How late the channel of an observation is.
double DelayOf(const MotionProblem& problem, const Eigen::VectorXd& parameters,
               const Observation& one) {
  const auto c = static_cast<std::size_t>(one.channel);
  int late = kNoParameter;
  if (one.kind == ObservationKind::kImu) late = problem.imus[c].late;
  if (one.kind == ObservationKind::kReceiver) late = problem.receivers[c].late;
  if (one.kind == ObservationKind::kAxis) late = problem.axes[c].late;
  if (one.kind == ObservationKind::kPose) late = problem.poses[c].late;
  return late < 0 ? 0 : parameters[late];
}

}  // namespace

bool Linearise(const MotionProblem& problem, const UniformSpline& spline,
               const SegmentMotion& motion, const Eigen::VectorXd& parameters,
               const Observation& observation, LinearisedObservation* out) {
  const double late_s = DelayOf(problem, parameters, observation);
  const double shift_s = motion.shift_s - late_s, from_s = observation.from_s + shift_s,
               to_s = observation.to_s + shift_s;
  if (!spline.Covers(from_s, to_s)) return false;
  out->weights = spline.MeanOver(from_s, to_s);
  const int count = std::min<int>(5, spline.coefficients - out->weights.first);
  const Numbers numbers = motion.coefficients.middleRows(out->weights.first, count).transpose() *
                          out->weights.by_derivative.leftCols(count).transpose();
  Numbers resting = numbers;
  const auto block = std::min<Eigen::Index>((out->weights.first + 1) / 4, motion.moving.rows() - 1);
  resting.rightCols<3>().array().colwise() *= motion.moving.row(block).transpose();
  const At at{problem, parameters, observation, numbers, resting, out};
  const auto channel = static_cast<std::size_t>(observation.channel);
  switch (observation.kind) {
    case ObservationKind::kImu:
      LineariseImu(problem.imus[channel], at);
      break;
    case ObservationKind::kReceiver:
      LineariseReceiver(problem.receivers[channel], at);
      break;
    case ObservationKind::kAxis:
      LineariseAxis(problem.axes[channel], at);
      break;
    case ObservationKind::kPose:
      LinearisePose(problem.poses[channel], at);
      break;
    case ObservationKind::kTravel:
      LineariseTravel(at);
      break;
    case ObservationKind::kStill:
      LineariseStill(at);
      break;
    case ObservationKind::kRest:
      LineariseRest(at);
      break;
    case ObservationKind::kGround:
      LineariseGround(at);
      break;
  }
  return true;
}

}  // namespace tera
