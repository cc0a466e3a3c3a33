#pragma once

#include "diagnose/motion/filtered_unit.h"
#include "diagnose/motion/linearised_observation.h"

namespace tera {

/// Row: coordinate of the motion; column: its value and first three derivatives at one time.
using Numbers = Eigen::Matrix<double, Eigen::Dynamic, 4>;

/// Everything that the linearisation of one observation needs.
struct MotionAt {
  const MotionProblem& problem;
  const Eigen::VectorXd& parameters;
  const Observation& observation;
  const Numbers& numbers;
  const Numbers& resting;        ///< `numbers` with insignificant derivatives set to 0
  const FilteredUnit* filtered;  ///< filter of the observed unit; null without a filter
  double from_s, to_s;           ///< time of the observation on the spline
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
  /// Factor on the acceleration along a coordinate, as inertial units measure it.
  double Share(int number) const { return 1 + Parameter(GainOf(number)); }
  /// Column in `by_state` of a derivative of a coordinate.
  int Column(int number, int derivative) const { return derivative * columns() + number; }
  int AddParameter(int place) const {
    out->parameter[static_cast<std::size_t>(out->parameters)] = place;
    out->by_parameter.col(out->parameters).setZero();
    return out->parameters++;
  }
  /// Adds the derivative by a delay: a later channel sees an earlier motion.
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
