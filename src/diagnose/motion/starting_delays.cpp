#include "diagnose/motion/starting_delays.h"

#include <array>
#include <cmath>
#include <limits>

#include "diagnose/motion/linearise.h"
#include "diagnose/statistics/tests/opposition.h"

namespace tera {
namespace {

constexpr double kStep_s = 0.05;
constexpr int kSteps = 10;  ///< number of steps to either side: 0.5 s
constexpr double kLeastCorrelation = 0.7, kAlpha = 0.01;
constexpr double kLeastShare = 0.5;     ///< a new delay must reduce the mean square by this share
constexpr std::size_t kMostRows = 600;  ///< largest number of a unit's rows in the mean square
constexpr std::size_t kFewestRows = 20;

/// An even subset of a unit's observations, each with the index of its segment.
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

/// One row of a unit: its measurements, and the predictions from the motion.
struct BesideMotion {
  std::vector<double> measured, implied;
};

/// Measurements and predictions of a unit's six rows where the motion covers them.
std::array<BesideMotion, 6> Compared(const MotionProblem& problem, const MotionEstimate& at,
                                     const UnitRows& rows, const Eigen::VectorXd& parameters) {
  std::array<BesideMotion, 6> compared;
  LinearisedObservation linear;
  std::vector<SegmentLinearisation> about;
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    about.emplace_back(problem, problem.segments[s].spline, at.motion[s], parameters);
  }
  for (const auto& [s, observation] : rows.rows) {
    if (!about[s].Of(*observation, &linear)) continue;
    for (int i = 0; i < 6; ++i) {
      BesideMotion& row = compared[static_cast<std::size_t>(i)];
      row.measured.push_back(observation->value[i]);
      row.implied.push_back(observation->value[i] - linear.residual[i]);
    }
  }
  return compared;
}

/// Mean square of measured minus predicted turn rates. Infinite for too few observations.
double MeanSquare(const std::array<BesideMotion, 6>& compared) {
  double square = 0;
  const std::size_t count = compared[0].measured.size();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < count; ++k) {
      square += std::pow(compared[i].measured[k] - compared[i].implied[k], 2);
    }
  }
  return count < kFewestRows ? std::numeric_limits<double>::infinity()
                             : square / static_cast<double>(count);
}

/// Uncentred correlation, so that samples at rest add nothing.
double Correlation(const BesideMotion& row) {
  double both = 0, one = 0, two = 0;
  for (std::size_t k = 0; k < row.measured.size(); ++k) {
    both += row.measured[k] * row.implied[k];
    one += row.measured[k] * row.measured[k], two += row.implied[k] * row.implied[k];
  }
  const bool is_known = row.measured.size() >= kFewestRows && one > 0 && two > 0;
  return is_known ? both / std::sqrt(one * two) : 0;
}

std::vector<OpposedAxis> OpposedOf(const MotionProblem& problem, const MotionEstimate& at,
                                   std::size_t unit) {
  const UnitRows rows = RowsOf(problem, static_cast<int>(unit));
  Eigen::VectorXd parameters = at.parameters;
  const double own_s = parameters[problem.imus[unit].late];
  std::array<double, 6> most{}, p{};
  for (int k = -kSteps; k <= kSteps; ++k) {
    parameters[problem.imus[unit].late] = own_s + k * kStep_s;
    const auto compared = Compared(problem, at, rows, parameters);
    for (std::size_t i = 0; i < 6; ++i) {
      const double here = Correlation(compared[i]);
      if (std::abs(here) <= std::abs(most[i])) continue;
      most[i] = here;
      p[i] = here < -kLeastCorrelation ? OppositionP(compared[i].measured, compared[i].implied) : 1;
    }
  }
  const double tries = 6.0 * (2 * kSteps + 1) * static_cast<double>(problem.imus.size());
  std::vector<OpposedAxis> opposed;
  for (std::size_t i = 0; i < 6; ++i) {
    if (most[i] < -kLeastCorrelation && tries * p[i] <= kAlpha) {
      opposed.push_back({unit, static_cast<int>(i), tries * p[i]});
    }
  }
  return opposed;
}

bool IsHalfATurn(const std::vector<OpposedAxis>& opposed) {
  return opposed.size() == 4 && opposed[0].row + 3 == opposed[2].row &&
         opposed[1].row + 3 == opposed[3].row;
}

}  // namespace

std::vector<OpposedAxis> OpposedAxes(const MotionProblem& problem, const MotionEstimate& motion) {
  std::vector<OpposedAxis> opposed;
  for (std::size_t unit = 0; unit < problem.imus.size(); ++unit) {
    if (problem.imus[unit].late < 0) continue;
    const std::vector<OpposedAxis> own = OpposedOf(problem, motion, unit);
    if (!IsHalfATurn(own)) opposed.insert(opposed.end(), own.begin(), own.end());
  }
  return opposed;
}

void SetStartingDelays(const MotionProblem& problem, MotionEstimate* start) {
  for (std::size_t unit = 0; unit < problem.imus.size(); ++unit) {
    const int late = problem.imus[unit].late;
    if (late < 0) continue;
    const UnitRows rows = RowsOf(problem, static_cast<int>(unit));
    Eigen::VectorXd parameters = start->parameters;
    const double documented_s = parameters[late];
    double least = (1 - kLeastShare) * MeanSquare(Compared(problem, *start, rows, parameters));
    for (int k = -kSteps; k <= kSteps; ++k) {
      parameters[late] = documented_s + k * kStep_s;
      const double square = MeanSquare(Compared(problem, *start, rows, parameters));
      if (square >= least) continue;
      least = square;
      start->parameters[late] = parameters[late];
    }
  }
}

}  // namespace tera
