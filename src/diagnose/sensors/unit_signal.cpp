#include "diagnose/sensors/unit_signal.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnose/motion/linearise.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr double kLikelier = 3.0;  ///< log odds, twenty to one, from which a range is tried

/// Excess of each delay over its documented value, minus the median excess.
std::vector<double> ExcessDelays_s(const SensorProblem& problem, const Eigen::VectorXd& fitted) {
  std::vector<double> excess_s;
  for (const int i : problem.motion.delays) {
    excess_s.push_back(fitted[i] -
                       problem.table.parameters[static_cast<std::size_t>(i)].documented);
  }
  const double common_s = excess_s.empty() ? 0 : Median(excess_s);
  for (double& one : excess_s) one -= common_s;
  return excess_s;
}

/// Measurements of a triad and their predictions from the motion.
struct BesideMotion {
  double largest = 0;                       ///< largest measured magnitude
  std::vector<std::array<double, 3>> rows;  ///< measured, predicted, error variance
};

std::array<BesideMotion, 2> BesideMotionOf(const MotionProblem& problem, std::size_t unit,
                                           const MotionEstimate& at) {
  std::array<BesideMotion, 2> triads;
  LinearisedObservation linear;
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    const MotionSegment& segment = problem.segments[s];
    const Eigen::VectorXd parameters = at.parameters + at.motion[s].wandered;
    const SegmentLinearisation about(problem, segment.spline, at.motion[s], parameters);
    for (const Observation& seen : segment.observations) {
      const bool is_of_unit =
          seen.kind == ObservationKind::kImu && seen.channel == static_cast<int>(unit);
      if (!is_of_unit || !about.Of(seen, &linear)) continue;
      for (int i = 0; i < 6; ++i) {
        const NoiseChannel& noise = at.noise[static_cast<std::size_t>(linear.noise + i)];
        BesideMotion& triad = triads[static_cast<std::size_t>(i / 3)];
        triad.largest = std::max(triad.largest, std::abs(seen.value[i]));
        triad.rows.push_back({seen.value[i], seen.value[i] - linear.residual[i],
                              noise.inflation * noise.sigma * noise.sigma / seen.share +
                                  seen.model_error[i] * seen.model_error[i]});
      }
    }
  }
  return triads;
}

struct Limit {
  double value = kNoLimit, sigma = 0;
};

/// The apparent limit of a triad; kNoLimit where it gains too little.
Limit LimitOf(const BesideMotion& triad) {
  double gain = 0, variance = 0;
  std::vector<double> there;
  for (const auto& [measured, implied, of_error] : triad.rows) {
    if (std::abs(implied) <= triad.largest) continue;
    const double clipped = std::copysign(triad.largest, implied);
    gain += (std::pow(measured - implied, 2) - std::pow(measured - clipped, 2)) / (2 * of_error);
    there.push_back(std::abs(measured));
    variance += of_error;
  }
  if (gain < kLikelier) return {};
  const auto count = static_cast<double>(there.size());
  return {Median(std::move(there)), std::sqrt(variance) / count};
}

void Grow(SensorProblem* problem, MotionEstimate* start) {
  const auto before = start->parameters.size();
  problem->motion.parameters = static_cast<int>(problem->table.parameters.size());
  problem->motion.wander = problem->table.Wander();
  const auto added = problem->motion.parameters - before;
  const auto grow = [&](Eigen::VectorXd* parameters) {
    parameters->conservativeResize(problem->motion.parameters);
    parameters->tail(added).setZero();
  };
  grow(&start->parameters);
  for (SegmentMotion& motion : start->motion) grow(&motion.wandered);
}

/// The problem with a low pass in unit `u`. `start` replaces the unit's excess delay by a filter
/// with a time constant `excess_s` above the documented one.
SensorProblem WithLowPass(const SensorDescription& unit, std::size_t u, double excess_s,
                          SensorProblem problem, MotionEstimate* start) {
  UnitChannel& channel = problem.motion.imus[u];
  AddLowPass(unit, &problem.table, &channel);
  Grow(&problem, start);
  const double time_constant_s = problem.table.parameters.back().documented + excess_s;
  start->parameters[channel.low_pass] = time_constant_s;
  start->parameters[channel.late] -= time_constant_s;
  return problem;
}

const SensorDescription& SensorOf(const DiagnosisInput& input, const std::string& name) {
  return *std::find_if(input.sensors.begin(), input.sensors.end(),
                       [&](const auto& one) { return one.name == name; });
}

}  // namespace

const std::string& UnitOf(const SensorProblem& problem, std::size_t unit) {
  const auto own = std::find_if(
      problem.table.groups.begin(), problem.table.groups.end(),
      [&](const ParameterGroup& one) { return one.first == problem.motion.imus[unit].bias; });
  return own->target;
}

double LogScale(const MotionEstimate& estimate) {
  double sum = 0;
  for (std::size_t c = 0; c < estimate.noise.size(); ++c) {
    std::size_t count = 0;
    for (const auto& segment : estimate.residuals[c].by_segment) count += segment.size();
    sum += static_cast<double>(count) * std::log(estimate.noise[c].sigma);
  }
  return sum;
}

MotionEstimate WithLowPasses(const DiagnosisInput& input, const EstimateOptions& options,
                             MotionEstimate best, SensorProblem* problem) {
  const std::vector<double> excess_s = ExcessDelays_s(*problem, best.parameters);
  for (std::size_t d = 0; d < excess_s.size(); ++d) {
    const int late = problem->motion.delays[d];
    const auto& imus = problem->motion.imus;
    const auto own = std::find_if(imus.begin(), imus.end(),
                                  [&](const UnitChannel& one) { return one.late == late; });
    const double tolerance_s = problem->table.parameters[static_cast<std::size_t>(late)].tolerance;
    if (own == imus.end() || excess_s[d] <= tolerance_s) continue;
    const auto u = static_cast<std::size_t>(own - imus.begin());
    const MotionEstimate delayed =
        EstimateMotion(problem->motion, problem->table.FlexiblePrior(), best, options);
    MotionEstimate start = best;
    SensorProblem tried =
        WithLowPass(SensorOf(input, UnitOf(*problem, u)), u, excess_s[d], *problem, &start);
    MotionEstimate filtered =
        EstimateMotion(tried.motion, tried.table.FlexiblePrior(), std::move(start), options);
    const SensorParameter& low_pass = tried.table.parameters.back();
    const double longer_s =
        filtered.parameters[tried.motion.imus[u].low_pass] - low_pass.documented;
    if (longer_s <= low_pass.tolerance || LogScale(filtered) >= LogScale(delayed)) continue;
    best = std::move(filtered);
    *problem = std::move(tried);
  }
  return best;
}

MotionEstimate WithClipping(const DiagnosisInput& input, const EstimateOptions& options,
                            MotionEstimate best, SensorProblem* problem) {
  for (std::size_t u = 0; u < problem->motion.imus.size(); ++u) {
    const SensorDescription& unit = SensorOf(input, UnitOf(*problem, u));
    const auto triads = BesideMotionOf(problem->motion, u, best);
    const std::array<double, 2> documented = DocumentedLimits(unit);
    std::array<Limit, 2> limits;
    bool is_exceeded = false;
    for (std::size_t i = 0; i < 2; ++i) {
      limits[i] = LimitOf(triads[i]);
      is_exceeded = is_exceeded || limits[i].value != kNoLimit;
      if (documented[i] != kNoLimit) limits[i] = {documented[i], 0};
    }
    if (!is_exceeded) continue;
    const MotionEstimate without =
        EstimateMotion(problem->motion, problem->table.FlexiblePrior(), best, options);
    SensorProblem tried = *problem;
    UnitChannel& channel = tried.motion.imus[u];
    channel.limit = {limits[0].value, limits[1].value};
    AddClipping(unit, {limits[0].sigma, limits[1].sigma}, &tried.table, &channel);
    MotionEstimate start = best;
    Grow(&tried, &start);
    for (int i = 0; i < 2; ++i) {
      const bool has_limit = limits[static_cast<std::size_t>(i)].value != kNoLimit;
      start.parameters[channel.clipped + i] = has_limit ? 1 : 0;
    }
    MotionEstimate clipped =
        EstimateMotion(tried.motion, tried.table.FlexiblePrior(), std::move(start), options);
    if (LogScale(clipped) >= LogScale(without)) continue;
    best = std::move(clipped);
    *problem = std::move(tried);
  }
  return best;
}

}  // namespace tera
