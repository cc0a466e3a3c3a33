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

constexpr double kLeastShare = 0.02;
constexpr double kAlpha = 0.01;           ///< of any interval where there is noise alone
constexpr double kLeastDeviation = 1e-6;  ///< of a residual, where there is no noise
constexpr double kLoud = 3;               ///< times the noise
constexpr double kLoudWithoutRest = 10;   ///< the same, where slow noise is not known
constexpr double kLongestRun = 3;  ///< deviation of means over that of single samples: AR(1) of 0.8
constexpr double kLongestRunWithoutRest = 10;  ///< the same, over what third differences say of it
constexpr double kNearlyAsMuch = 0.95;
constexpr double kMuchMore = 1.3;  ///< times the criterion of what was significant

struct Told {
  std::size_t variable;
  double p, share;
};

/// Of all variables before any was taken in, the one that explains most, more than `least`; of
/// those that explain nearly as much, the one that is least likely to do so by chance.
Told MostTelling(const std::vector<RegimeTestResult>& tests, double least) {
  const auto tells = [&](const RegimeTestResult& test) {
    return test.criterion > kLeastShare && test.whole_criterion > least;
  };
  double most = least;
  for (const RegimeTestResult& test : tests) {
    if (tells(test)) most = std::max(most, test.whole_criterion);
  }
  Told told{tests.size(), 1, 0};
  for (std::size_t v = 0; v < tests.size(); ++v) {
    if (!tells(tests[v]) || tests[v].whole_criterion < kNearlyAsMuch * most) continue;
    const double p = tests[v].comparison.p;
    const bool is_better =
        told.variable == tests.size() || p < told.p ||
        (p == told.p && tests[v].whole_criterion > tests[told.variable].whole_criterion);
    if (is_better) told = {v, p, tests[v].share};
  }
  return told;
}

/// The variables that were taken in. Before them one that explains much more but moves too slowly
/// for a p that means anything, as time does; alone, if none was taken in.
std::vector<Told> Telling(const Partialling& found) {
  std::vector<Told> telling;
  double least = kLeastShare;
  if (!found.steps.empty()) {
    const PartiallingStep& first = found.steps.front();
    least = std::max(least, kMuchMore * first.tests[first.variable].criterion);
  }
  const auto& tests = found.steps.empty() ? found.left : found.steps.front().tests;
  const Told slow = MostTelling(tests, least);
  const bool is_first = !found.steps.empty() && slow.variable == found.steps.front().variable;
  if (slow.variable < tests.size() && !is_first) telling.push_back(slow);
  for (const PartiallingStep& step : found.steps) {
    if (step.variable == slow.variable && !is_first) continue;
    telling.push_back({step.variable, step.p_adjusted, step.share});
  }
  return telling;
}

/// Stretches of either list, in order, joined where they meet.
std::vector<Segment> Either(std::vector<Segment> a, const std::vector<Segment>& b) {
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

/// Deviation of the noise, of a sample or of a mean over many if that is more. A noise model that
/// was fitted beside what the free member could not follow takes that for noise which remembers;
/// the noise at rest, or what differences between samples say of it, sets a bound to it.
double LongRunDeviation(const NoiseModel& noise, const NoiseLevel& level) {
  const double deviation = std::sqrt(std::max(VarianceOf(noise), LongRunVarianceOf(noise)));
  return std::min(deviation, (level.at_rest ? kLongestRun : kLongestRunWithoutRest) * level.rms());
}

/// Where a residual is more than noise: as it comes, by innovations, and as it stays, by itself.
std::vector<Segment> Mismatch(const Series& residual, const NoiseModel& noise,
                              const NoiseLevel& level) {
  const std::vector<Segment> as_it_comes =
      FindChangePoints(Whiten(noise, residual).Steady(), noise.dof, {.alpha = kAlpha / 2}).mismatch;
  const double deviation =
      std::max(LongRunDeviation(noise, level), kLeastDeviation * Rms(residual));
  if (deviation == 0) return as_it_comes;
  Series by_itself = residual;
  for (double& value : by_itself.value) value /= deviation;
  return Either(
      as_it_comes,
      FindChangePoints(by_itself, noise.dof, {.alpha = kAlpha / 2, .guarded = false}).mismatch);
}

/// What a regime is judged beside, and after how many samples a residual says something new.
struct Beside {
  NoiseModel noise;
  double repeats = 1;
};

/// The noise, or, where the residual is much louder, white noise of its size. What else is wrong
/// then counts for more than what was measured badly, and differences from sample to sample no
/// more than levels do.
Beside NoiseBeside(const Series& residual, const NoiseModel& noise, const NoiseLevel& level) {
  const double rms = Rms(residual);
  if (rms <= (level.at_rest ? kLoud : kLoudWithoutRest) * level.rms()) return {noise};
  return {{.scale = rms, .dof = 10}, static_cast<double>(CorrelationLength(ValidValues(residual)))};
}

/// The channel's variables, and each again as what a share of the simulated value may depend on.
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

/// What is known when a variable is asked: what came before, and what its curve is multiplied with.
Eigen::MatrixXd KnownBefore(const Eigen::MatrixXd& known, const RegimeAxis& axis) {
  return axis.has_times() ? WithColumns(known, axis.times()) : known;
}

/// Of intervals, that in which the squares of a residual exceed those of noise the most.
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
  const Beside beside = NoiseBeside(residual, noise, level);
  const std::vector<RegimeVariable> variables = VariablesAndShares(channel, residual);
  const Partialling found =
      SelectRegimes(residual, beside.noise, variables,
                    {.test = {.repeats = beside.repeats}, .threads = threads}, stream);
  Eigen::MatrixXd known(static_cast<Eigen::Index>(residual.size()), 0);
  for (const auto& [index_of_variable, p, share] : Telling(found)) {
    const RegimeVariable& variable = variables[index_of_variable];
    const RegimeAxis axis(variable);
    Regime regime{variable.name, axis.has_times(), p, share, {}, {}};
    regime.curve =
        FitRegimeCurve(residual, beside.noise, KnownBefore(known, axis), variable, {}, stream);
    regime.shape = ClassifyCurve(regime.curve);
    location.regimes.push_back(std::move(regime));
    known = WithColumns(known, KnownColumns(axis));
  }
  return location;
}

}  // namespace tera
