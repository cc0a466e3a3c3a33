#include "diagnose/motion/starting_delays.h"

#include <cmath>
#include <limits>

#include "diagnose/motion/linearise.h"

namespace tera {
namespace {

constexpr double kFurthest_s = 0.5, kStep_s = 0.05;
constexpr double kLeastShare = 0.5;     ///< by which a delay lessens the mean square
constexpr std::size_t kMostRows = 600;  ///< of a unit, of which the mean square is taken
constexpr std::size_t kFewestRows = 20;

/// Observations of one unit, evenly out of all, with their segments.
struct UnitRows {
  std::vector<std::pair<std::size_t, const Observation*>> rows;
};

UnitRows RowsOf(const MotionProblem& problem, int unit) {
  UnitRows all, some;
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    for (const Observation& one : problem.segments[s].observations) {
      if (one.kind == ObservationKind::kImu && one.channel == unit) all.rows.emplace_back(s, &one);
    }
  }
  const std::size_t every = all.rows.size() / kMostRows + 1;
  for (std::size_t k = 0; k < all.rows.size(); k += every) some.rows.push_back(all.rows[k]);
  return some;
}

/// Mean square of the unit's rates less those of the motion; infinite where it covers too few.
double MeanSquare(const MotionProblem& problem, const MotionEstimate& start, const UnitRows& rows,
                  const Eigen::VectorXd& parameters) {
  LinearisedObservation linear;
  double square = 0;
  std::size_t count = 0;
  for (const auto& [s, observation] : rows.rows) {
    const SegmentMotion& motion = start.motion[s];
    if (!Linearise(problem, problem.segments[s].spline, motion.coefficients, parameters,
                   motion.moving, *observation, &linear)) {
      continue;
    }
    square += linear.residual.head<3>().squaredNorm();
    ++count;
  }
  return count < kFewestRows ? std::numeric_limits<double>::infinity()
                             : square / static_cast<double>(count);
}

}  // namespace

void SetStartingDelays(const MotionProblem& problem, MotionEstimate* start) {
  for (std::size_t unit = 0; unit < problem.imus.size(); ++unit) {
    const int late = problem.imus[unit].late;
    if (late < 0) continue;
    const UnitRows rows = RowsOf(problem, static_cast<int>(unit));
    Eigen::VectorXd parameters = start->parameters;
    const double documented_s = parameters[late];
    double least = (1 - kLeastShare) * MeanSquare(problem, *start, rows, parameters);
    const int steps = static_cast<int>(std::lround(kFurthest_s / kStep_s));
    for (int k = -steps; k <= steps; ++k) {
      parameters[late] = documented_s + k * kStep_s;
      const double square = MeanSquare(problem, *start, rows, parameters);
      if (square >= least) continue;
      least = square;
      start->parameters[late] = parameters[late];
    }
  }
}

}  // namespace tera
