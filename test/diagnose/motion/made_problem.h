#pragma once

#include <vector>

#include "diagnose/motion/linearise.h"
#include "diagnose/motion/random_machine.h"

// A problem with one channel of every kind and all parameters, on a machine with a hinge and a
// slide, under a motion with random coefficients.

namespace tera {

struct MadeProblem {
  MotionProblem problem;
  UniformSpline spline = {.step_s = 0.25, .coefficients = 16};
  Eigen::MatrixXd coefficients;
  Eigen::VectorXd parameters;
  Eigen::ArrayXXd moving;

  explicit MadeProblem(std::uint64_t seed) {
    const Stream draw(seed, "problem");
    MachineModel model = RandomMachine(seed, {JointType::kRevolute, JointType::kPrismatic});
    const KinematicChain chain = *ChainTo(model, 2, {0, 1});
    problem.joints = {"hinge", "slide"};
    int next = 0;
    const auto take = [&next](int count) {
      next += count;
      return next - count;
    };
    UnitChannel unit;
    unit.chain = chain;
    unit.X_LS = RandomPose(draw, 50);
    unit.signs << 1, -1, -1, -1, 1, -1;
    unit.bias = take(6), unit.scale = take(6), unit.mount = take(3), unit.place = take(3);
    unit.late = take(1), unit.noise = 0;
    problem.imus = {unit};
    ReceiverChannel receiver;
    receiver.chain = chain;
    receiver.p_LS_m = {0.3, 0.8, 1.9};
    receiver.middle_L_m = {0.3, 0.1, 1.9};
    receiver.place = take(3), receiver.datum = take(3), receiver.pair_yaw = take(1);
    receiver.late = take(1), receiver.noise = 6;
    problem.receivers = {receiver};
    AxisChannel axis;
    axis.number = kBaseNumbers + 1;
    axis.bias = take(1), axis.scale = take(1), axis.late = take(1), axis.noise = 9;
    problem.axes = {axis};
    MapChannel map;
    map.pivot_m = {4, -3, 1};
    map.shift = take(3), map.turn = take(3), map.late = take(1), map.noise = 10;
    problem.poses = {map};
    problem.acceleration_gains.assign(problem.numbers(), kNoParameter);
    for (const int number : {int{kYaw}, kBaseNumbers, kBaseNumbers + 1}) {
      problem.acceleration_gains[number] = take(1);
    }
    problem.imus[0].clipped = take(2);
    problem.imus[0].limit = {0.4, 9};
    problem.noise.resize(16);
    problem.parameters = next;
    problem.wander = Eigen::VectorXd::Zero(next);

    coefficients.resize(spline.coefficients, problem.numbers());
    for (int i = 0; i < coefficients.size(); ++i) coefficients.data()[i] = 0.3 * draw.Gaussian(i);
    coefficients.col(kYaw).array() += 1.2;
    parameters.resize(next);
    for (int i = 0; i < next; ++i) parameters[i] = 0.05 * draw.Gaussian(1000 + i);
    for (const int scale : {unit.scale, unit.scale + 1, unit.scale + 2, unit.scale + 3,
                            unit.scale + 4, unit.scale + 5, axis.scale}) {
      parameters[scale] += 1;
    }
    moving = Eigen::ArrayXXd::Ones((spline.coefficients + 3) / 4, problem.numbers());
  }
  /// One observation of each kind within a step, another over a knot.
  std::vector<Observation> Observations() const {
    std::vector<Observation> all;
    using enum ObservationKind;
    for (const ObservationKind kind :
         {kImu, kReceiver, kAxis, kPose, kTravel, kStill, kRest, kGround}) {
      for (const double from_s : {1.03, 1.18}) {
        const bool lasts = kind == kImu || kind == kTravel || kind == kStill || kind == kRest;
        Observation seen = {.kind = kind, .from_s = from_s, .to_s = from_s + (lasts ? 0.13 : 0)};
        seen.value << 0.3, -0.2, 0.5, 0.1, 0.2, -0.4;
        all.push_back(seen);
      }
    }
    return all;
  }
  bool Of(const Observation& seen, LinearisedObservation* out) const {
    const SegmentMotion motion{coefficients, moving, {}};
    return SegmentLinearisation(problem, spline, motion, parameters).Of(seen, out);
  }
  /// The residual's derivative by each motion coefficient, numbers running fastest, by `by_state`
  /// and the spline's weights.
  Eigen::MatrixXd ByCoefficients(const LinearisedObservation& rows) const {
    const int numbers = problem.numbers();
    Eigen::MatrixXd by = Eigen::MatrixXd::Zero(rows.rows, spline.coefficients * numbers);
    for (int k = 0; k < 5; ++k) {
      const int i = rows.weights.first + k;
      if (i >= spline.coefficients) continue;
      for (int number = 0; number < numbers; ++number) {
        for (int d = 0; d < 3; ++d) {
          by.col(i * numbers + number) +=
              rows.by_state.topRows(rows.rows).col(d * numbers + number) *
              rows.weights.by_derivative(d, k);
        }
      }
    }
    return by;
  }
  Eigen::MatrixXd ByParameters(const LinearisedObservation& rows) const {
    Eigen::MatrixXd by = Eigen::MatrixXd::Zero(rows.rows, problem.parameters);
    for (int k = 0; k < rows.parameters; ++k) {
      by.col(rows.parameter[k]) += rows.by_parameter.topRows(rows.rows).col(k);
    }
    return by;
  }
};

}  // namespace tera
