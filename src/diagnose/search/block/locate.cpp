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

/// Share of a residual's energy below which a variable is not worth naming.
constexpr double kLeastExplainedShare = 0.02;
constexpr double kAlpha = 0.01;  ///< of any interval being found where there is noise alone
constexpr double kLeastDeviation = 1e-6;  ///< of a residual, where there is no noise at all
/// RMS of a residual over that of the noise above which regimes are judged beside white noise.
constexpr double kLeastRatioToNoise = 3;
/// The bound kLeastRatioToNoise, for a recording without rest, where slow noise is not known.
constexpr double kLeastRatioToNoiseWithoutRest = 10;
/// Deviation of long means over the noise's RMS at rest, at most: that of AR(1) with 0.8.
constexpr double kMostLongRunRatio = 3;
/// The bound kMostLongRunRatio, over what third differences say of the noise, for a recording
/// without rest.
constexpr double kMostLongRunRatioWithoutRest = 10;
/// Explained share over the largest above which a variable counts as explaining as much.
constexpr double kLeastShareOfLargest = 0.95;
/// Criterion over that of the best significant variable above which a variable that is not
/// significant comes first.
constexpr double kLeastCriterionRatio = 1.3;

/// A variable that explains part of a residual.
struct Regressor {
  std::size_t variable;
  double p, share;
};

/// The variable that by itself explains most of the residual, more than `least`; among those that
/// explain nearly as much, the one of the smallest p.
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

/// The variables of the forward selection, in its order. A variable that explains much more than
/// the first of them but moves too slowly for a p that means anything, as time does, comes before
/// them; it is the only one where the selection is empty.
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

/// Union of two lists of intervals, in order, joined where they meet.
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

/// Standard deviation of the noise, of single samples or of long means, whichever is larger. A
/// noise model takes what the flexible regressor does not follow for noise with a long memory; the
/// noise at rest, or what differences between samples say of it, bounds how much that may be.
double LongRunDeviation(const NoiseModel& noise, const NoiseLevel& level) {
  const double deviation = std::sqrt(std::max(VarianceOf(noise), LongRunVarianceOf(noise)));
  return std::min(deviation,
                  (level.at_rest ? kMostLongRunRatio : kMostLongRunRatioWithoutRest) * level.rms());
}

/// Where a residual is more than noise: by innovations, which show where it comes and goes, and by
/// its own level, which shows where it stays.
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

/// The noise that regimes are tested against.
struct RegimeNoise {
  NoiseModel noise;
  double repeats = 1;  ///< samples after which the residual says something new
};

/// The channel's noise, or, where the residual is much louder, white noise of the residual's size:
/// other errors then count for more than noise of measurement, and levels as much as differences
/// from sample to sample.
RegimeNoise NoiseForRegimes(const Series& residual, const NoiseModel& noise,
                            const NoiseLevel& level) {
  const double rms = Rms(residual);
  const double ratio = level.at_rest ? kLeastRatioToNoise : kLeastRatioToNoiseWithoutRest;
  if (rms <= ratio * level.rms()) return {noise};
  return {{.scale = rms, .dof = 10}, static_cast<double>(CorrelationLength(ValidValues(residual)))};
}

/// The channel's variables, each twice: the error may be a function of it, or the simulated value
/// times a function of it.
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

/// The columns that are held fixed while a variable's curve is fitted: those of the regressors
/// before it, and what its curve is multiplied with.
Eigen::MatrixXd KnownBefore(const Eigen::MatrixXd& known, const RegimeAxis& axis) {
  return axis.has_times() ? WithColumns(known, axis.times()) : known;
}

/// The interval in which the squares of a residual exceed those of noise the most.
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

}  // namespace

Location Locate(const Channel& channel, std::size_t index, const Series& residual,
                const NoiseModel& noise, const NoiseLevel& level, const Stream& stream,
                int threads) {
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
  for (const auto& [index_of_variable, p, share] : RankedRegressors(found)) {
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
