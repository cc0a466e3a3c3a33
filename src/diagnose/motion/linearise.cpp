#include "diagnose/motion/linearise.h"

#include <ceres/jet.h>

#include <algorithm>

#include "diagnose/motion/linearise_unit.h"
#include "diagnose/motion/link_motion.h"

namespace tera {
namespace {

// Deviations of travel by the running gear. They are wide, so that travel determines the motion
// only where no other sensor does.
constexpr double kTravelShare = 0.3, kTravel_mps = 0.1, kTravel_radps = 0.1;
// A standing machine rocks while its arm moves, but hardly turns.
constexpr double kRocks_mps = 0.03, kRocks_radps = 0.05, kTurns_radps = 0.01;
constexpr double kGround_m = 0.05, kGround_rad = 0.035;
constexpr double kFilterShare = 0.2;  ///< time step of a filtered unit, in knots of the spline
constexpr double kLeastTimeConstant_s = 1e-3;  ///< shorter time constants filter nothing

/// Adds the four parameters of a reflection. Returns the position error in W.
Vec3 AddReflection(const ReceiverChannel& receiver, const MotionAt& at) {
  if (receiver.reflection < 0) return Vec3::Zero();
  const Eigen::Matrix<double, 3, 4> by_number =
      ByReflection(receiver.raised.At(Eigen::VectorXd(at.numbers.col(0))));
  for (int i = 0; i < 4; ++i) {
    const int column = at.AddParameter(receiver.reflection + i);
    at.out->by_parameter.block<3, 1>(0, column) = by_number.col(i);
  }
  return by_number * at.parameters.segment<4>(receiver.reflection);
}

// Layout of a receiver's derivatives: angles (3), joints, place (3), yaw of the pair.
constexpr int kGnssJoints = 3, kGnssPlace = kGnssJoints + kMostJointsOfChain,
              kGnssYaw = kGnssPlace + 3, kGnssDerivatives = kGnssYaw + 1;

void LineariseReceiver(const ReceiverChannel& receiver, const MotionAt& at) {
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

void LineariseAxis(const AxisChannel& axis, const MotionAt& at) {
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

void LinearisePose(const MapChannel& poses, const MotionAt& at) {
  using T = ceres::Jet<double, 9>;  // position, angles, rotation of the map
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

void LineariseTravel(const MotionAt& at) {
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

void LineariseStill(const MotionAt& at) {
  at.Begin(6, kNoParameter);
  LinearisedObservation& out = *at.out;
  for (int i = 0; i < 6; ++i) {
    out.residual[i] = -at.numbers(i, 1);
    out.sigma[i] = i < 3 ? kRocks_mps : i == kYaw ? kTurns_radps : kRocks_radps;
    out.by_state(i, at.Column(i, 1)) = 1;
  }
}

void LineariseRest(const MotionAt& at) {
  at.Begin(1, kNoParameter);
  const int number = at.observation.channel;
  at.out->residual[0] = -at.numbers(number, 1);
  at.out->sigma[0] = kTurns_radps;
  at.out->by_state(0, at.Column(number, 1)) = 1;
}

void LineariseGround(const MotionAt& at) {
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

Numbers NumbersAt(const SegmentMotion& motion, const SplineWeights& weights) {
  const auto count = std::min<Eigen::Index>(5, motion.coefficients.rows() - weights.first);
  return motion.coefficients.middleRows(weights.first, count).transpose() *
         weights.by_derivative.leftCols(count).transpose();
}

/// Sets derivatives of coordinates that do not move significantly to 0.
Numbers Resting(const SegmentMotion& motion, const SplineWeights& weights, Numbers numbers) {
  const auto block = std::min<Eigen::Index>((weights.first + 1) / 4, motion.moving.rows() - 1);
  numbers.rightCols<3>().array().colwise() *= motion.moving.row(block).transpose();
  return numbers;
}

}  // namespace

SegmentLinearisation::SegmentLinearisation(const MotionProblem& problem,
                                           const UniformSpline& spline, const SegmentMotion& motion,
                                           const Eigen::VectorXd& parameters)
    : problem_(problem), spline_(spline), motion_(motion), parameters_(parameters) {
  for (const UnitChannel& unit : problem.imus) {
    filtered_.emplace_back();
    if (unit.low_pass >= 0) filtered_.back() = Filtered(unit);
  }
}

FilteredUnit SegmentLinearisation::Filtered(const UnitChannel& unit) const {
  const double step_s = kFilterShare * spline_.step_s;
  const auto count = static_cast<Eigen::Index>(spline_.end_s() / step_s);
  FilteredUnit::Rows moved(6, count), rests(6, count);
  const Observation none;
  for (Eigen::Index k = 0; k < count; ++k) {
    const SplineWeights weights = spline_.At(static_cast<double>(k) * step_s);
    const Numbers numbers = NumbersAt(motion_, weights),
                  resting = Resting(motion_, weights, numbers);
    const MotionAt at{problem_, parameters_, none, numbers, resting, nullptr, 0, 0, nullptr};
    moved.col(k) = IdealOf(unit, at, numbers);
    rests.col(k) = IdealOf(unit, at, resting);
  }
  return {step_s, std::max(parameters_[unit.low_pass], kLeastTimeConstant_s), moved, rests};
}

double SegmentLinearisation::DelayOf(const Observation& one) const {
  const auto c = static_cast<std::size_t>(one.channel);
  int late = kNoParameter;
  if (one.kind == ObservationKind::kImu) late = problem_.imus[c].late;
  if (one.kind == ObservationKind::kReceiver) late = problem_.receivers[c].late;
  if (one.kind == ObservationKind::kAxis) late = problem_.axes[c].late;
  if (one.kind == ObservationKind::kPose) late = problem_.poses[c].late;
  return late < 0 ? 0 : parameters_[late];
}

bool SegmentLinearisation::Of(const Observation& observation, LinearisedObservation* out) const {
  const auto channel = static_cast<std::size_t>(observation.channel);
  const double shift_s = motion_.shift_s - DelayOf(observation),
               from_s = observation.from_s + shift_s, to_s = observation.to_s + shift_s;
  const FilteredUnit* filtered = nullptr;
  double behind_s = 0;
  if (observation.kind == ObservationKind::kImu && problem_.imus[channel].low_pass >= 0) {
    filtered = &*filtered_[channel];
    behind_s = std::max(0.0, parameters_[problem_.imus[channel].low_pass]);
  }
  if (!spline_.Covers(from_s - behind_s, to_s)) return false;
  out->weights = spline_.MeanOver(from_s - behind_s, to_s - behind_s);
  const Numbers numbers = NumbersAt(motion_, out->weights),
                resting = Resting(motion_, out->weights, numbers);
  const MotionAt at{problem_, parameters_, observation, numbers, resting,
                    filtered, from_s,      to_s,        out};
  switch (observation.kind) {
    case ObservationKind::kImu:
      LineariseUnit(problem_.imus[channel], at);
      break;
    case ObservationKind::kReceiver:
      LineariseReceiver(problem_.receivers[channel], at);
      break;
    case ObservationKind::kAxis:
      LineariseAxis(problem_.axes[channel], at);
      break;
    case ObservationKind::kPose:
      LinearisePose(problem_.poses[channel], at);
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
