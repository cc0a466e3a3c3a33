#pragma once

#include "diagnose/motion/filtered_unit.h"
#include "diagnose/motion/linearised_observation.h"

namespace tera {

/// Numbers of the motion at a time, by derivative, one column each.
using Numbers = Eigen::Matrix<double, Eigen::Dynamic, 4>;

/// The time of an observation, with all that its linearisation needs.
struct MotionAt {
  const MotionProblem& problem;
  const Eigen::VectorXd& parameters;
  const Observation& observation;
  const Numbers& numbers;
  const Numbers& resting;        ///< the same, 0 where they are no more than noise
  const FilteredUnit* filtered;  ///< of the observation's unit; null without a filter
  double from_s, to_s;           ///< the time of the observation, in that of the motion
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

}  // namespace tera
