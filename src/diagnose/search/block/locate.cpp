#include "diagnose/search/block/locate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnose/statistics/regime/partialling.h"
#include "diagnose/statistics/series/robust.h"
#include "diagnose/statistics/series/whitening.h"
#include "diagnose/statistics/tests/change_points.h"

namespace tera {
namespace {

/// Smallest share of a residual's energy for a variable to be named.
constexpr double kLeastExplainedShare = 0.02;
constexpr double kAlpha = 0.01;  ///< probability of any interval under noise alone
/// Smallest noise deviation, for a residual without noise.
constexpr double kLeastDeviation = 1e-6;
/// Ratio of residual to noise RMS above which variables are tested against white noise.
constexpr double kLeastRatioToNoise = 3;
/// The same without rest, where slow noise is unknown.
constexpr double kLeastRatioToNoiseWithoutRest = 10;
/// Largest ratio of the deviation of long means to the noise at rest: that of AR(1) with
/// coefficient 0.8.
constexpr double kMostLongRunRatio = 3;
/// The same relative to third differences, without rest.
constexpr double kMostLongRunRatioWithoutRest = 10;
/// Variables above this share of the largest explain equally much.
constexpr double kLeastShareOfLargest = 0.95;
/// Ratio of criteria above which an insignificant variable precedes the best significant one.
constexpr double kLeastCriterionRatio = 1.3;

struct Regressor {
  std::size_t variable;
  double p, share;
};

/// The variable that alone explains most of the residual, and more than `least`. Among equals, the
/// smallest p wins.
Regressor BestRegressor(const std::vector<RegimeTestResult>& tests, double least) {
  const auto explains = [&](const RegimeTestResult& test) {
    return test.criterion > kLeastExplainedShare && test.whole_criterion > least;
  };
  double most = least;
  for (const RegimeTestResult& test : tests) {
    if (explains(test)) most = std::max(most, test.whole_criterion);
  }
  Regressor best{tests.size(), 1, 0};
  for (std::size_t v = 0; v < tests.size(); ++v) {
    if (!explains(tests[v]) || tests[v].whole_criterion < kLeastShareOfLargest * most) continue;
    const double p = tests[v].comparison.p;
    const bool is_better =
        best.variable == tests.size() || p < best.p ||
        (p == best.p && tests[v].whole_criterion > tests[best.variable].whole_criterion);
    if (is_better) best = {v, p, tests[v].share};
  }
  return best;
}

/// Variables in the order of the forward selection. A variable that explains much more than the
/// first precedes it, even if it moves too slowly for a valid p, as time does. If the selection is
/// empty, only that variable is returned.
std::vector<Regressor> RankedRegressors(const Partialling& found) {
  std::vector<Regressor> ranked;
  double least = kLeastExplainedShare;
  if (!found.steps.empty()) {
    const PartiallingStep& first = found.steps.front();
    least = std::max(least, kLeastCriterionRatio * first.tests[first.variable].criterion);
  }
  const auto& tests = found.steps.empty() ? found.left : found.steps.front().tests;
  const Regressor slow = BestRegressor(tests, least);
  const bool is_first = !found.steps.empty() && slow.variable == found.steps.front().variable;
  if (slow.variable < tests.size() && !is_first) ranked.push_back(slow);
  for (const PartiallingStep& step : found.steps) {
    if (step.variable == slow.variable && !is_first) continue;
    ranked.push_back({step.variable, step.p_adjusted, step.share});
  }
  return ranked;
}

/// Sorted union of two lists of intervals. Intervals that touch are joined.
std::vector<Segment> Union(std::vector<Segment> a, const std::vector<Segment>& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::sort(a.begin(), a.end(),
            [](const Segment& x, const Segment& y) { return x.begin < y.begin; });
  std::vector<Segment> joined;
  for (const Segment& one : a) {
    if (!joined.empty() && one.begin <= joined.back().end) {
      joined.back().end = std::max(joined.back().end, one.end);
    } else {
      joined.push_back(one);
    }
  }
  return joined;
}

/// Deviation of the noise, of single samples or of long means, whichever is larger. A noise model
/// takes errors that the flexible regressor cannot follow for noise with long memory. The noise at
/// rest, or third differences, therefore limit it.
double LongRunDeviation(const NoiseModel& noise, const NoiseLevel& level) {
  const double deviation = std::sqrt(std::max(VarianceOf(noise), LongRunVarianceOf(noise)));
  return std::min(deviation,
                  (level.at_rest ? kMostLongRunRatio : kMostLongRunRatioWithoutRest) * level.rms());
}

/// Intervals in which a residual exceeds noise. Innovations show where an error begins and ends;
/// the level shows where it persists.
std::vector<Segment> Mismatch(const Series& residual, const NoiseModel& noise,
                              const NoiseLevel& level) {
  const std::vector<Segment> by_innovations =
      FindChangePoints(Whiten(noise, residual).Steady(), noise.dof, {.alpha = kAlpha / 2}).mismatch;
  const double deviation =
      std::max(LongRunDeviation(noise, level), kLeastDeviation * Rms(residual));
  if (deviation == 0) return by_innovations;
  Series by_level = residual;
  for (double& value : by_level.value) value /= deviation;
  return Union(
      by_innovations,
      FindChangePoints(by_level, noise.dof, {.alpha = kAlpha / 2, .guarded = false}).mismatch);
}

struct RegimeNoise {
  NoiseModel noise;
  double repeats = 1;  ///< samples between independent errors
};

/// The channel's noise, or white noise of the residual's size for a much larger residual. There,
/// model error outweighs measurement noise, and levels count as much as differences between
/// samples.
RegimeNoise NoiseForRegimes(const Series& residual, const NoiseModel& noise,
                            const NoiseLevel& level) {
  const double rms = Rms(residual);
  const double ratio = level.at_rest ? kLeastRatioToNoise : kLeastRatioToNoiseWithoutRest;
  if (rms <= ratio * level.rms()) return {noise};
  return {{.scale = rms, .dof = 10}, static_cast<double>(CorrelationLength(ValidValues(residual)))};
}

/// Columns held fixed while a variable's curve is fitted: those of earlier regressors, and the
/// factor of the curve.
Eigen::MatrixXd KnownBefore(const Eigen::MatrixXd& known, const RegimeAxis& axis) {
  return axis.has_times() ? WithColumns(known, axis.times()) : known;
}

/// The interval in which the squared residual exceeds noise most.
std::size_t WorstOf(const std::vector<Segment>& intervals, const Series& residual,
                    double noise_variance) {
  std::size_t worst = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    double excess = 0;
    for (std::size_t k = intervals[i].begin; k < intervals[i].end; ++k) {
      if (residual.valid[k]) excess += std::pow(residual.value[k], 2) - noise_variance;
    }
    if (excess <= most) continue;
    most = excess;
    worst = i;
  }
  return worst;
}

std::vector<Regressor> LedBy(const std::optional<LeadingVariable>& leading,
                             const std::vector<RegimeTestResult>& tests,
                             std::vector<Regressor> ranked) {
  if (!leading) return ranked;
  std::erase_if(ranked, [&](const Regressor& one) { return one.variable == leading->index; });
  ranked.insert(ranked.begin(), {leading->index, leading->p, tests[leading->index].share});
  return ranked;
}

}  // namespace

std::vector<RegimeVariable> VariablesAndShares(const Channel& channel, const Series& residual) {
  std::vector<double> simulated(residual.size(), 0.0);
  for (std::size_t k = 0; k < residual.size(); ++k) {
    if (residual.valid[k]) simulated[k] = channel.measured.value[k] - residual.value[k];
  }
  std::vector<RegimeVariable> variables = channel.variables;
  for (const RegimeVariable& variable : channel.variables) {
    variables.push_back(variable);
    variables.back().times = simulated;
  }
  return variables;
}

Location Locate(const Channel& channel, std::size_t index, const Series& residual,
                const NoiseModel& noise, const NoiseLevel& level, const Stream& stream, int threads,
                const std::optional<LeadingVariable>& leading) {
  Location location{index, {}, 0, {}};
  location.intervals = Mismatch(residual, noise, level);
  location.worst = WorstOf(location.intervals, residual, std::pow(level.rms(), 2));
  if (channel.variables.empty()) return location;
  const RegimeNoise against = NoiseForRegimes(residual, noise, level);
  const std::vector<RegimeVariable> variables = VariablesAndShares(channel, residual);
  const Partialling found =
      SelectRegimes(residual, against.noise, variables,
                    {.test = {.repeats = against.repeats}, .threads = threads}, stream);
  Eigen::MatrixXd known(static_cast<Eigen::Index>(residual.size()), 0);
  const auto& alone = found.steps.empty() ? found.left : found.steps.front().tests;
  for (const auto& [index_of_variable, p, share] : LedBy(leading, alone, RankedRegressors(found))) {
    const RegimeVariable& variable = variables[index_of_variable];
    const RegimeAxis axis(variable);
    Regime regime{variable.name, axis.has_times(), p, share, {}, {}};
    regime.curve =
        FitRegimeCurve(residual, against.noise, KnownBefore(known, axis), variable, stream);
    regime.shape = ClassifyCurve(regime.curve);
    location.regimes.push_back(std::move(regime));
    known = WithColumns(known, KnownColumns(axis));
  }
  return location;
}

}  // namespace tera
