#include "diagnose/perception/registration/calibration_jacobian.h"

#include <vector>

#include "diagnose/blocks/candidate_list.h"

namespace tera {
namespace {

/// Half the width of a difference quotient, of a parameter's range: microradians of an angle.
constexpr double kDifference = 1e-7;

/// The small change that leads from one calibration to another.
CalibrationVector ChangeBetween(const SensorCalibration& from, const SensorCalibration& to) {
  CalibrationVector change;
  change.segment<3>(kShiftOfMount) = to.X_BT.translation() - from.X_BT.translation();
  const Mat3 turn = to.X_BT.linear() * from.X_BT.linear().transpose();
  change.segment<3>(kTurnOfMount) =
      0.5 * Vec3(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  change[kRangeBias] = to.range_bias_m - from.range_bias_m;
  change[kRangeFactor] = to.range_factor - from.range_factor;
  change[kClockOffset] = to.clock_offset_s - from.clock_offset_s;
  return change;
}

}  // namespace

CalibrationJacobian JacobianOf(const Pose& X_BS, const Effects& present, const Structure& terms) {
  std::vector<CalibrationVector> columns;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    for (const FreeParameter& free : terms[t].Free()) {
      const double step = kDifference * (free.upper - free.lower);
      const auto moved = [&](double by) {
        Structure near = terms;
        near[t].values[free.index] += by;
        return CalibrationUnder(X_BS, WithTerms(present, near));
      };
      columns.push_back(ChangeBetween(moved(-step), moved(step)) / (2 * step));
    }
  }
  CalibrationJacobian jacobian(kCalibrationElements, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    jacobian.col(static_cast<Eigen::Index>(c)) = columns[c];
  }
  return jacobian;
}

}  // namespace tera
